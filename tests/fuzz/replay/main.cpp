// Runs a fuzz target without libFuzzer: over its kept corpus, and over so many changes of it, drawn from a
// seed. It has no guidance by coverage, needs no clang, and takes a second or two.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size);

namespace {

using Draw = std::mt19937_64;

constexpr std::uint64_t kSeed = 20261122;
constexpr std::size_t kLongest = 8192;

std::vector<std::string> corpus_of(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    files.push_back(entry.path());
  }
  std::ranges::sort(files);
  std::vector<std::string> corpus;
  for (const auto& file : files) {
    std::ifstream stream(file, std::ios::binary);
    corpus.emplace_back(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
  }
  return corpus;
}

/// A place from 0 up to the size.
std::size_t place(Draw& draw, std::size_t size) { return size == 0 ? 0 : draw() % size; }

void change(std::string& bytes, const std::string& other, Draw& draw) {
  const std::size_t at = place(draw, bytes.size());
  switch (draw() % 5) {
    case 0:
      if (!bytes.empty()) bytes[at] = static_cast<char>(draw());
      break;
    case 1:
      bytes.erase(at, 1 + place(draw, 64));
      break;
    case 2:
      bytes.insert(at, bytes.substr(place(draw, bytes.size()), 1 + place(draw, 64)));
      break;
    case 3:
      bytes.insert(at, other.substr(place(draw, other.size()), 1 + place(draw, 256)));
      break;
    default: {
      static const std::string extremes[] = {std::string(8, '\0'), std::string(8, '\xFF'), "1e999",
                                             "-", "\x7F", "[[", "\"", "nan"};
      bytes.insert(at, extremes[place(draw, std::size(extremes))]);
    }
  }
  if (bytes.size() > kLongest) bytes.resize(kLongest);
}

void run(const std::string& bytes) {
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
}

}  // namespace

int main(int count, char** given) {
  if (count != 3) {
    std::fprintf(stderr, "usage: %s CORPUS CHANGES\n", given[0]);
    return 2;
  }
  const std::vector<std::string> corpus = corpus_of(given[1]);
  if (corpus.empty()) {
    std::fprintf(stderr, "%s holds nothing\n", given[1]);
    return 1;
  }
  for (const std::string& bytes : corpus) run(bytes);
  Draw draw(kSeed);
  const long changes = std::atol(given[2]);
  for (long k = 0; k < changes; ++k) {
    std::string bytes = corpus[place(draw, corpus.size())];
    for (std::size_t n = 1 + place(draw, 4); n > 0; --n) {
      change(bytes, corpus[place(draw, corpus.size())], draw);
    }
    run(bytes);
  }
  std::printf("%zu kept, %ld changed\n", corpus.size(), changes);
  return 0;
}
