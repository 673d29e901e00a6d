#include "output_folder.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "flexspline/data/checksum.hpp"

namespace flexspline::app {
namespace {

namespace fs = std::filesystem;

/// The path without links, as far as it exists.
fs::path resolved(const fs::path& path) {
  std::error_code error;
  fs::path whole = fs::weakly_canonical(fs::absolute(path), error);
  if (error) whole = fs::absolute(path, error).lexically_normal();
  return whole.has_filename() ? whole : whole.parent_path();
}

/// Both resolved. True for the folder itself.
bool lies_in(const fs::path& path, const fs::path& folder) {
  return std::ranges::mismatch(folder, path).in1 == folder.end();
}

tl::unexpected<Error> refuse(const fs::path& folder, const std::string& why,
                             const std::string& remedy) {
  return failure(ErrorCode::cannot_write, fmt::format("--out {} {}", folder.string(), why), remedy);
}

Result<void> keep_apart(const fs::path& shown, const fs::path& place, const fs::path& read) {
  const fs::path input = resolved(read);
  const char* how = place == input          ? "is"
                    : lies_in(place, input) ? "lies in"
                    : lies_in(input, place) ? "holds"
                                            : nullptr;
  if (how == nullptr) return {};
  return refuse(shown, fmt::format("{} the input {}", how, read.string()),
                "choose a folder of its own; what is read is never written to");
}

/// Neither the folder nor a link in it leads to what is read.
Result<void> keep_inputs_apart(const OutputWish& wish) {
  std::vector<fs::path> places = {resolved(wish.folder)};
  std::error_code error;
  fs::recursive_directory_iterator entry(wish.folder, error);
  for (; !error && entry != fs::recursive_directory_iterator(); entry.increment(error)) {
    std::error_code unknown;
    if (entry->is_symlink(unknown) && entry->is_directory(unknown)) {
      places.push_back(resolved(entry->path()));
    }
  }
  for (const fs::path& place : places) {
    for (const fs::path& read : wish.read) {
      if (auto apart = keep_apart(wish.folder, place, read); !apart) return apart;
    }
  }
  return {};
}

/// "a.csv, b.csv and 3 more"; empty for an empty folder.
std::string content_of(const fs::path& folder) {
  constexpr std::size_t kTold = 3;
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    std::string name = entry.path().filename().string();
    if (name.starts_with('.') && name.ends_with(".part")) continue;  // somebody's file on its way
    names.push_back(std::move(name));
  }
  std::ranges::sort(names);
  const std::size_t more = names.size() > kTold ? names.size() - kTold : 0;
  names.resize(names.size() - more);
  return fmt::format("{}{}", fmt::join(names, ", "),
                     more > 0 ? fmt::format(" and {} more", more) : "");
}

/// ": seed is 7 there and 8 here; ..."; empty where nothing is known.
std::string differences(const OutputWish& wish) {
  constexpr std::size_t kTold = 12;
  if (!wish.differs || wish.differs->empty()) return "";
  std::vector<std::string> told = *wish.differs;
  const std::size_t more = told.size() > kTold ? told.size() - kTold : 0;
  told.resize(told.size() - more);
  return fmt::format(": {}{}", fmt::join(told, "; "),
                     more > 0 ? fmt::format("; and {} more keys", more) : "");
}

/// True: it is empty, or does not exist yet, or was claimed and nothing came of it.
Result<bool> check_content(const OutputWish& wish, const data::Manifest& wanted) {
  const std::string content = content_of(wish.folder);
  if (content.empty()) return true;
  const auto earlier = data::read_manifest(wish.folder);
  if (earlier && !earlier->finished && content == data::kManifestFile) return true;
  if (wish.force || (earlier && earlier->same_origin(wanted))) return false;
  if (earlier && earlier->command == wish.command && wish.differs && wish.differs->empty()) {
    return false;
  }
  constexpr const char* kRemedy =
      "choose another folder, or add --force to replace what has the same name there";
  if (!earlier) {
    return refuse(wish.folder,
                  fmt::format("holds what {} did not write: {}", wish.command, content), kRemedy);
  }
  const bool same_name = earlier->command == wish.command && earlier->input == wish.input;
  if (!same_name) {
    return refuse(wish.folder,
                  fmt::format("holds what {} wrote of '{}', not {} of '{}'{}", earlier->command,
                              earlier->input, wish.command, wish.input, differences(wish)),
                  kRemedy);
  }
  return refuse(
      wish.folder,
      fmt::format("holds what {} wrote of another '{}'{}", earlier->command, earlier->input,
                  wish.differs ? differences(wish)
                               : ": the name is the same, where it lies and what it says "
                                 "are not"),
      kRemedy);
}

fs::path topmost_missing(const fs::path& folder) {
  fs::path missing;
  std::error_code error;
  for (fs::path at = resolved(folder); !at.empty() && !fs::exists(at, error);
       at = at.parent_path()) {
    missing = at;
  }
  return missing;
}

void remove_empty(fs::path folder, const fs::path& last) {
  std::error_code error;
  for (; lies_in(folder, last) && fs::remove(folder, error); folder = folder.parent_path()) {
  }
}

}  // namespace

Result<OutputFolder> OutputFolder::claim(const OutputWish& wish) {
  std::error_code error;
  if (fs::exists(wish.folder, error) && !fs::is_directory(wish.folder, error)) {
    return refuse(wish.folder, "is a file", "choose a folder");
  }
  if (auto apart = keep_inputs_apart(wish); !apart) return tl::unexpected(apart.error());
  OutputFolder claimed;
  claimed.folder_ = wish.folder;
  const std::string place =
      wish.place.empty() ? "" : data::sha256_hex(resolved(wish.place).generic_string());
  claimed.manifest_ = {wish.command, wish.input, wish.sha256, place, false, {}};
  const auto empty = check_content(wish, claimed.manifest_);
  if (!empty) return tl::unexpected(empty.error());
  claimed.taken_over_ = !*empty;
  claimed.made_ = topmost_missing(wish.folder);
  if (auto written = data::write_manifest(wish.folder, claimed.manifest_); !written) {
    return tl::unexpected(written.error());
  }
  return claimed;
}

OutputFolder::OutputFolder(OutputFolder&& other) noexcept
    : folder_(std::exchange(other.folder_, {})),
      made_(std::move(other.made_)),
      manifest_(std::move(other.manifest_)),
      taken_over_(other.taken_over_),
      finished_(other.finished_) {}

OutputFolder::~OutputFolder() {
  if (folder_.empty() || finished_ || taken_over_) return;
  if (content_of(folder_) != data::kManifestFile) return;
  std::error_code error;
  fs::remove(folder_ / data::kManifestFile, error);
  if (!made_.empty()) remove_empty(resolved(folder_), made_);
}

Result<void> OutputFolder::finish(std::span<const std::string> names) {
  auto sums = data::checksums(folder_, names);
  if (!sums) return tl::unexpected(sums.error());
  manifest_.files = std::move(*sums);
  manifest_.finished = true;
  finished_ = true;
  return data::write_manifest(folder_, manifest_);
}

Result<void> refresh_manifest(const fs::path& folder, std::span<const std::string> names) {
  auto manifest = data::read_manifest(folder);
  if (!manifest || !manifest->finished) return {};
  auto sums = data::checksums(folder, names);
  if (!sums) return tl::unexpected(sums.error());
  for (auto& [file, sum] : *sums) manifest->files[file] = std::move(sum);
  return data::write_manifest(folder, *manifest);
}

}  // namespace flexspline::app
