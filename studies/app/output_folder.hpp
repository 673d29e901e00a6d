#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "command.hpp"
#include "flexspline/core/error.hpp"
#include "flexspline/data/manifest.hpp"

namespace flexspline::app {

/// Option of every command that writes a folder.
inline constexpr ArgumentInfo kForce = {
    .name = "--force",
    .meaning = "write into a folder that holds other things: what has the same name is replaced",
    .value = {}};

/// What a command wants to write, and from what.
struct OutputWish {
  std::string command;
  std::filesystem::path folder;
  std::string input;            ///< name of what it is made from
  std::string sha256;           ///< of its content
  std::filesystem::path place;  ///< where it lies; empty: another content is another thing
  std::vector<std::filesystem::path> read;  ///< files and folders that are never written to
  bool force = false;
  /// What it says otherwise than what the folder holds, key by key; none: it says the same,
  /// whatever its bytes. Absent: not known.
  std::optional<std::vector<std::string>> differs{};
};

/// A folder that a command may write to. It says what it holds in its manifest.json: from the
/// beginning by which command and from what, at the end every file with its checksum.
class OutputFolder {
 public:
  /// Before any work: the folder is made where it does not exist, and claimed in its manifest.
  /// Errors: cannot_write, where it cannot be made or written to; where it is, lies in or holds
  /// something that is read; where it holds anything else than the same command wrote from the
  /// same thing, unless forced.
  static Result<OutputFolder> claim(const OutputWish& wish);

  OutputFolder(OutputFolder&& other) noexcept;
  OutputFolder& operator=(OutputFolder&&) = delete;
  /// Takes the folder away again where nothing came of it.
  ~OutputFolder();

  /// Enters the checksums of what was written: names of files, and of folders for all in them.
  /// Errors: cannot_write, input_missing.
  Result<void> finish(std::span<const std::string> names);

 private:
  OutputFolder() = default;

  std::filesystem::path folder_;
  std::filesystem::path made_;  ///< topmost folder that was made for it; empty: it was there
  data::Manifest manifest_;
  bool taken_over_ = false;  ///< it held something before
  bool finished_ = false;
};

/// Enters the checksums of files that were drawn again, in a folder that is finished.
/// Errors: cannot_write, input_missing.
Result<void> refresh_manifest(const std::filesystem::path& folder,
                              std::span<const std::string> names);

}  // namespace flexspline::app
