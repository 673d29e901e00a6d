#pragma once

#include <string>
#include <vector>

#include "import/import_parts.hpp"
#include "import/recording_rows.hpp"

namespace flexspline::data {

/// Takes the rows of the parts of a joined table and passes on one row for each instant of the
/// first, where all of them have a value: of the others that between the two samples around,
/// linearly; of marks (valid, drive enabled) the lesser of the two. The columns wanted are kept in
/// memory.
class JoinedRows : public TableSink {
 public:
  JoinedRows(const FoundTable& table, const TableLimits& limits, RecordingRows& rows);

  std::vector<std::size_t> begin(const TableHead& head) override;
  void rows(std::span<const std::vector<double>> columns) override;
  void note(const std::string&) override {}

  /// Once all parts are read. Errors: bad_data, where they take more memory than they may, or time
  /// falls.
  Result<void> join();
  std::vector<std::string> notes() const;

 private:
  struct Part {
    const TablePart* of = nullptr;
    std::vector<std::size_t> wanted;  ///< of its table, rising
    std::size_t clock = 0;            ///< of wanted
    std::vector<std::vector<double>> values;
    std::size_t next = 0;
  };
  struct Place {
    std::size_t part = 0;
    std::size_t value = 0;  ///< of the part's wanted
    bool mark = false;
  };

  void place_channels();
  Result<void> check_clocks();
  bool take_row(std::size_t row, std::vector<double>& to);

  const FoundTable& table_;
  std::size_t most_values_;
  RecordingRows& rows_;
  std::vector<Part> parts_;
  std::vector<Place> places_;  ///< by channel
  Part* at_hand_ = nullptr;
  std::size_t index_ = 0;
  std::size_t values_ = 0;
  std::size_t between_ = 0;
  std::size_t alone_ = 0;
  std::size_t written_ = 0;
};

}  // namespace flexspline::data
