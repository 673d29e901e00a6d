#pragma once

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "flexspline/core/error.hpp"

namespace flexspline::data {

/// What an output folder says of itself: which command writes it, from what, and once it is
/// finished the SHA-256 of every file.
struct Manifest {
  std::string command;  ///< "run"
  std::string input;    ///< name of the study, data set or model it is made from
  std::string sha256;   ///< of that input's content
  std::string place;    ///< SHA-256 of where that input lies; empty: it counts by its content alone
  bool finished = false;
  std::map<std::string, std::string> files;  ///< path in the folder, with '/': SHA-256

  /// Whether both are written by one command from one thing: the same content, or what lies in the
  /// same place under the same name and has been edited.
  bool same_origin(const Manifest& other) const;
};

inline constexpr const char* kManifestFile = "manifest.json";

/// flexspline-manifest/1. Errors: cannot_write.
Result<void> write_manifest(const std::filesystem::path& folder, const Manifest& manifest);

/// Errors: input_missing where the folder has none; bad_data when its checksum does not hold.
Result<Manifest> read_manifest(const std::filesystem::path& folder);

/// SHA-256 of the files of these names and of all files in folders of these names, by their paths
/// in the folder. Names that are not there, what was set aside (.stale) and half-written files
/// (.part) are left out. Errors: input_missing for a file that cannot be read.
Result<std::map<std::string, std::string>> checksums(const std::filesystem::path& folder,
                                                     std::span<const std::string> names);

struct ChangedFile {
  std::string file;
  bool missing = false;  ///< else its content is not what it was
};

/// Files of a finished folder that are not as they were written, in the order of their names.
std::vector<ChangedFile> changed_files(const std::filesystem::path& folder,
                                       const Manifest& manifest);

}  // namespace flexspline::data
