#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "flexspline/core/error.hpp"
#include "flexspline/core/recording.hpp"

namespace flexspline::data {

/// One thing that is wrong with (or worth knowing of) a file.
struct Finding {
  std::string file;
  int line = 0;  ///< 1-based; 0: the file as a whole
  int column = 0;
  std::string problem;  ///< names the key, column or value
  std::string remedy;

  /// "file:line:column: problem; remedy".
  std::string message() const;
};

/// A data set as far as it could be read: everything wrong at once.
struct DatasetReading {
  std::optional<RecordingSet> set;  ///< present only when there are no errors
  std::vector<Finding> errors;
  std::vector<Finding> notes;          ///< e.g. columns that were ignored
  std::vector<std::string> decisions;  ///< those of the notes that become notes of the set
};

/// Reads a data set of format "flexspline-dataset/1": folder with dataset.toml and CSV tables.
/// Refuses what the format says must be refused, naming file, line and column.
DatasetReading read_dataset(const std::filesystem::path& folder);

/// Rows of a recording that commands use where nothing else is asked for.
inline constexpr std::size_t kMostRows = 20000;
inline constexpr std::size_t kAllRows = 0;

/// Every k-th row of recordings that have more than `most`, with a note for each in the set and its
/// checksum that of what is left. Where that would leave fewer than ten rows between two crossings
/// of a motion's middle, k is smaller and the end of the recording is left out. Samples stay as
/// they were measured: nothing is filtered, so noise stays white and reversals sharp; what is
/// faster than half of the new rate is aliased.
void thin_recordings(RecordingSet& set, std::size_t most);

/// A data set for callers that go no further on a failure, thinned to a most of rows a recording
/// (or kAllRows).
/// Errors: input_missing when there is no such folder or description, bad_data with every finding.
Result<RecordingSet> load_dataset(const std::filesystem::path& folder,
                                  std::size_t most_rows = kMostRows);

/// SHA-256 of what the recordings say: rig, constants, and of every recording, by id, its split,
/// nominal excitation and samples in SI. Names of folders, files and columns, their order and
/// remarks do not count. Values are rounded to 30 binary digits (1e-9), so that the same data
/// written in another unit hash alike but for one rounding in four million values.
std::string content_hash(const RecordingSet& set);

/// The unit in which a person reads the quantity: a display unit where it fits, else SI.
Unit display_unit(Quantity quantity, const DisplayUnits& display);

/// Writes a data set: dataset.toml and one CSV a recording, each written whole and renamed.
Result<void> write_dataset(const std::filesystem::path& folder, const RecordingSet& set);

}  // namespace flexspline::data
