#include "flexspline/data/manifest.hpp"

#include <nlohmann/json.hpp>

#include "flexspline/data/artefact.hpp"
#include "flexspline/data/checksum.hpp"

namespace flexspline::data {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

constexpr std::string_view kSchema = "flexspline-manifest/1";

Result<std::string> checksum_of(const fs::path& file) {
  Sha256 sum;
  return sum.add_file(file).transform([&] { return sum.hex(); });
}

std::vector<fs::path> files_under(const fs::path& path) {
  std::error_code error;
  if (fs::is_regular_file(path, error)) return {path};
  std::vector<fs::path> files;
  fs::recursive_directory_iterator entry(path, error);
  for (; !error && entry != fs::recursive_directory_iterator(); entry.increment(error)) {
    const fs::path extension = entry->path().extension();
    std::error_code unknown;
    if (extension != ".stale" && extension != ".part" && entry->is_regular_file(unknown)) {
      files.push_back(entry->path());
    }
  }
  return files;
}

}  // namespace

bool Manifest::same_origin(const Manifest& other) const {
  const bool edited = !place.empty() && place == other.place && input == other.input;
  return command == other.command && (sha256 == other.sha256 || edited);
}

Result<void> write_manifest(const fs::path& folder, const Manifest& manifest) {
  return write_artefact(
      folder / kManifestFile,
      {{"schema", kSchema},
       {"command", manifest.command},
       {"input",
        {{"name", manifest.input}, {"sha256", manifest.sha256}, {"place", manifest.place}}},
       {"finished", manifest.finished},
       {"files", manifest.files}});
}

Result<Manifest> read_manifest(const fs::path& folder) {
  const auto content = read_artefact(folder / kManifestFile, kSchema);
  if (!content) return tl::unexpected(content.error());
  try {
    const ordered_json& input = content->at("input");
    return Manifest{
        content->at("command"),  input.at("name"),
        input.at("sha256"),      input.at("place"),
        content->at("finished"), content->at("files").get<std::map<std::string, std::string>>()};
  } catch (const ordered_json::exception&) {
    return failure(ErrorCode::bad_data,
                   (folder / kManifestFile).string() + ": a key is missing or of another kind",
                   "make the folder again with the command that wrote it");
  }
}

Result<std::map<std::string, std::string>> checksums(const fs::path& folder,
                                                     std::span<const std::string> names) {
  std::map<std::string, std::string> sums;
  for (const std::string& name : names) {
    for (const fs::path& file : files_under(folder / name)) {
      const auto sum = checksum_of(file);
      if (!sum) return tl::unexpected(sum.error());
      sums[file.lexically_relative(folder).generic_string()] = *sum;
    }
  }
  return sums;
}

std::vector<ChangedFile> changed_files(const fs::path& folder, const Manifest& manifest) {
  std::vector<ChangedFile> changed;
  for (const auto& [file, sum] : manifest.files) {
    const auto now = checksum_of(folder / file);
    if (!now || *now != sum) changed.push_back({file, !now});
  }
  return changed;
}

}  // namespace flexspline::data
