#include "flexspline/data/dataset.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <span>

#include "flexspline/data/checksum.hpp"
#include "flexspline/data/sanity_codes.hpp"

namespace flexspline::data {
namespace {

constexpr int kDropped = 23;  // of the 52 binary digits after the point

std::uint64_t rounded(double value) {
  if (value == 0.0) return 0;  // either sign
  const auto bits = std::bit_cast<std::uint64_t>(value);
  return (bits + (std::uint64_t{1} << (kDropped - 1))) >> kDropped;
}

void add_word(Sha256& sum, std::uint64_t word) {
  char bytes[8];
  for (char& byte : bytes) {
    byte = static_cast<char>(word & 0xFF);
    word >>= 8;
  }
  sum.add({bytes, sizeof bytes});
}

void add_text(Sha256& sum, std::string_view text) {
  add_word(sum, text.size());
  sum.add(text);
}

void add_number(Sha256& sum, double value) { add_word(sum, rounded(value)); }

void add_number(Sha256& sum, const std::optional<double>& value) {
  add_word(sum, value ? 1 : 0);
  if (value) add_number(sum, *value);
}

void add_words(Sha256& sum, std::span<const std::uint64_t> words) {
  if constexpr (std::endian::native == std::endian::little) {
    sum.add({reinterpret_cast<const char*>(words.data()), words.size_bytes()});
  } else {
    for (const std::uint64_t word : words) add_word(sum, word);
  }
}

// In pieces: a series may be nearly as large as memory.
void add_series(Sha256& sum, Quantity quantity, std::span<const double> values) {
  add_text(sum, name_of(quantity));
  add_word(sum, values.size());
  std::array<std::uint64_t, 4096> words{};
  while (!values.empty()) {
    const auto piece = values.first(std::min(values.size(), words.size()));
    std::ranges::transform(piece, words.begin(), rounded);
    add_words(sum, std::span(words).first(piece.size()));
    values = values.subspan(piece.size());
  }
}

void add_recording(Sha256& sum, const Recording& recording) {
  add_text(sum, recording.id);
  add_word(sum, static_cast<std::uint64_t>(recording.split));
  add_number(sum, recording.start_s);
  add_number(sum, recording.amplitude);
  add_number(sum, recording.frequency_hz);
  add_series(sum, Quantity::time, recording.time);
  for (const auto& [quantity, values] : recording.channels) add_series(sum, quantity, values);
}

}  // namespace

std::string content_hash(const RecordingSet& set) {
  Sha256 sum;
  add_text(sum, name_of(set.rig));
  for (const auto& [name, value] : set.constants) {
    add_text(sum, name);
    add_number(sum, value);
  }
  for (const std::string_view code : accepted_findings(set)) add_text(sum, code);
  std::vector<const Recording*> sorted;
  for (const Recording& recording : set.recordings) sorted.push_back(&recording);
  std::ranges::sort(sorted, {}, [](const Recording* recording) { return recording->id; });
  for (const Recording* recording : sorted) add_recording(sum, *recording);
  return sum.hex();
}

}  // namespace flexspline::data
