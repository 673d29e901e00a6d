#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "flexspline/core/error.hpp"
#include "flexspline/data/table_reader.hpp"
#include "tables/csv_form.hpp"
#include "tables/time_stamp.hpp"

namespace flexspline::data {

/// Takes the lines of a text table as rows of its columns, block by block.
class CsvRows {
 public:
  /// wanted: of the columns; file: its name, for errors.
  CsvRows(const CsvForm& form, const std::vector<std::size_t>& wanted, std::string file,
          TableSink& sink);

  /// How the numbers of the next lines are written: as the form says, or with points.
  void use(const NumberForm& numbers);
  /// A line without its end; last: the file's last one, without an end. Errors: bad_data, with the
  /// line.
  Result<void> take(std::string_view line, std::size_t number, bool last);
  std::size_t rows() const { return rows_ + filled_; }
  bool has_stamps() const { return !plain_; }
  /// What is left goes to the sink, with what was found on the way. Errors: bad_data, where more
  /// than one line in a hundred is no row.
  Result<void> finish();

 private:
  /// Where something first happened, and how often.
  struct Incident {
    std::size_t count = 0;
    std::size_t line = 0;
    std::string text;

    void add(std::size_t at, std::string_view what);
  };

  void took_row();
  void flush();
  bool read_fast(std::string_view line);
  Result<void> read_slowly(std::string_view line);
  Result<double> cell(std::size_t column, std::string_view bare);
  double seconds(std::size_t column, const TimeStamp& stamp);
  tl::unexpected<Error> refused_at(std::size_t line, const std::string& problem,
                                   const std::string& remedy) const;

  const CsvForm& form_;
  std::string name_;
  TableSink& sink_;
  NumberForm numbers_;  ///< of the lines at hand
  std::vector<std::size_t> slots_;
  std::vector<std::vector<double>> block_;
  std::vector<std::string_view> cells_;
  std::vector<double> last_stamp_;
  std::vector<Incident> unread_;  ///< by column
  Incident ragged_;
  std::size_t line_ = 0;  ///< 1-based, of the line at hand
  std::size_t rows_ = 0;
  std::size_t filled_ = 0;  ///< of the block at hand
  bool plain_ = true;
  bool fast_ = true;
  bool last_ = false;  ///< the line at hand is the file's last, without an end
};

}  // namespace flexspline::data
