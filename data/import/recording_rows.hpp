#pragma once

#include <deque>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "import/import_parts.hpp"
#include "import/row_writer.hpp"

namespace flexspline::data {

/// One recording as it was written.
struct WrittenRecording {
  std::string id;
  std::string file;
  double start_s = 0.0;  ///< of its first row, on the file's clock
  std::size_t rows = 0;
};

/// Takes the rows of a table and writes recordings of them. Rows without time are left out, and
/// such that repeat the one before; samples under one stamp of a coarse clock are spread evenly;
/// where time falls, pauses, or nothing moves for split_s, a recording ends, if that is asked for.
class RecordingRows {
 public:
  RecordingRows(const FoundTable& table, const ImportParts& parts, std::optional<double> split_s,
                std::filesystem::path folder);

  /// A row of the table's channels in their order, in the file's units.
  void add(const std::vector<double>& row);
  /// Errors: bad_data, where time falls and nothing is to be cut; cannot_write.
  Result<void> finish();

  const std::vector<WrittenRecording>& recordings() const { return recordings_; }
  std::vector<std::string> notes() const;

 private:
  void take_group();
  void spread(double step);
  void place(const std::vector<double>& row);
  bool rests(const std::vector<double>& row);
  void write(const std::vector<double>& row);
  void release();
  void end_recording();
  void close();
  void fail(Error error);

  const FoundTable& table_;
  const ImportParts& parts_;
  std::optional<double> split_;  ///< in the file's unit of time
  std::filesystem::path folder_;
  double usual_step_;
  double zero_;                  ///< is taken from time: of clocks that count from far away
  std::vector<bool> same_unit_;  ///< as the set's, by channel
  std::vector<std::string> names_;
  std::optional<std::size_t> motion_;       ///< channel whose rest is looked for
  double still_ = 0.0;                      ///< less than this is no motion
  std::vector<std::vector<double>> group_;  ///< rows of one time stamp
  std::deque<std::vector<double>> resting_;
  double rest_value_ = 0.0;
  double rest_since_ = 0.0;
  bool resting_long_ = false;
  std::optional<double> last_;  ///< time of the row before
  std::optional<RowWriter> writer_;
  std::vector<WrittenRecording> recordings_;
  std::optional<Error> error_;
  std::size_t read_ = 0;
  std::size_t timeless_ = 0;
  std::size_t repeated_ = 0;
  std::size_t spread_ = 0;
  std::size_t rested_ = 0;
  std::size_t short_ = 0;
};

}  // namespace flexspline::data
