#include "readers/csv_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "readers/csv_number.hpp"

namespace flexspline::data {
namespace {

constexpr int kMostFindings = 20;

struct Cell {
  std::string_view text;  ///< without quotes and spaces around it
  std::size_t column;     ///< 1-based, of its first character in the line
};

Cell trimmed(std::string_view line, std::size_t from, std::size_t to) {
  constexpr std::string_view blank = " \t\r";
  const auto is_blank = [&](std::size_t at) { return blank.find(line[at]) != blank.npos; };
  while (from < to && is_blank(from)) ++from;
  while (to > from && is_blank(to - 1)) --to;
  if (to - from >= 2 && line[from] == '"' && line[to - 1] == '"') {
    return {trimmed(line.substr(0, to - 1), from + 1, to - 1).text, from + 1};
  }
  return {line.substr(from, to - from), from + 1};
}

void split(std::string_view line, char separator, std::vector<Cell>& cells) {
  cells.clear();
  std::size_t from = 0;
  while (true) {
    const std::size_t to = std::min(line.find(separator, from), line.size());
    cells.push_back(trimmed(line, from, to));
    if (to == line.size()) return;
    from = to + 1;
  }
}

bool is_blank(std::string_view line) { return line.find_first_not_of(" \t\r") == line.npos; }

/// Reads one file; its state is the line at hand.
class Parser {
 public:
  Parser(std::string_view text, const CsvColumns& wanted, std::string file, DatasetReading& reading)
      : rest_(text), wanted_(wanted), file_(std::move(file)), reading_(reading) {}

  CsvTable parse() {
    if (read_header()) read_rows();
    if (unsaid_ > 0) {
      reading_.errors.push_back({file_, 0, 0, fmt::format("{} more errors here", unsaid_),
                                 "correct the first ones and read again"});
    }
    return std::move(table_);
  }

 private:
  void refuse(std::size_t column, std::string problem, std::string remedy) {
    if (++said_ > kMostFindings) {
      ++unsaid_;
      return;
    }
    reading_.errors.push_back(
        {file_, number_, static_cast<int>(column), std::move(problem), std::move(remedy)});
  }

  bool next_line() {
    if (rest_.empty()) return false;
    const std::size_t end = std::min(rest_.find('\n'), rest_.size());
    line_ = rest_.substr(0, end);
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    ++number_;
    return true;
  }

  bool read_header() {
    if (rest_.starts_with("\xEF\xBB\xBF")) rest_.remove_prefix(3);
    if (rest_.starts_with("\xFF\xFE") || rest_.starts_with("\xFE\xFF")) {
      number_ = 1;
      refuse(1, "the table is UTF-16", "save it as UTF-8");
      return false;
    }
    if (!next_line() || is_blank(line_)) {
      number_ = 1;
      refuse(1, "the table has no header", "name the columns on the first line");
      return false;
    }
    choose_separator();
    split(line_, separator_, cells_);
    for (const Cell& cell : cells_) add_column(cell);
    table_.columns.resize(table_.header.size());
    return true;
  }

  void choose_separator() {
    for (const char candidate : {';', ',', '\t'}) {
      if (line_.find(candidate) == line_.npos) continue;
      separator_ = candidate;
      break;
    }
    if (separator_ != ';') return;
    reading_.notes.push_back({file_, 1, 1, "the columns are separated by semicolons",
                              "numbers are read with a decimal comma or point"});
  }

  void add_column(const Cell& cell) {
    const auto twin = std::ranges::find(table_.header, cell.text);
    if (twin != table_.header.end()) {
      refuse(cell.column, fmt::format("column '{}' stands here twice", cell.text),
             "give each column a name of its own");
    }
    table_.header.emplace_back(cell.text);
    is_wanted_.push_back(std::ranges::find(wanted_.names, cell.text) != wanted_.names.end());
    if (cell.text == wanted_.increasing) increasing_ = table_.header.size() - 1;
  }

  void read_rows() {
    const auto lines = static_cast<std::size_t>(std::ranges::count(rest_, '\n')) + 1;
    for (std::size_t i = 0; i < is_wanted_.size(); ++i) {
      if (is_wanted_[i]) table_.columns[i].reserve(lines);
    }
    while (next_line()) {
      if (is_blank(line_) && is_blank_to_the_end()) break;
      read_row();
    }
  }

  bool is_blank_to_the_end() const { return rest_.find_first_not_of(" \t\r\n") == rest_.npos; }

  void read_row() {
    split(line_, separator_, cells_);
    const bool whole = cells_.size() == table_.header.size();
    if (!whole) refuse_ragged();
    ++table_.rows;
    for (std::size_t i = 0; i < is_wanted_.size(); ++i) {
      if (is_wanted_[i]) table_.columns[i].push_back(whole ? read_cell(i) : kNoNumber);
    }
    if (whole && increasing_ < cells_.size()) check_increase(table_.columns[increasing_].back());
  }

  /// Against the last value that could be read; a comparison with NaN never refuses.
  void check_increase(double value) {
    if (value <= last_) {
      refuse(cells_[increasing_].column,
             fmt::format("column '{}' does not increase: {} after {}", wanted_.increasing, value,
                         last_),
             "sort the rows, and drop those that repeat a time");
    }
    if (!std::isnan(value)) last_ = value;
  }

  void refuse_ragged() {
    const bool doubled = separator_ == ',' && cells_.size() == 2 * table_.header.size();
    const std::size_t last = std::min(cells_.size(), table_.header.size() + 1);
    refuse(cells_[last - 1].column,
           fmt::format("{} cells in a table of {} columns", cells_.size(), table_.header.size()),
           doubled ? "numbers seem to have a decimal comma: write a point, or separate columns by ;"
                   : "give every row one cell a column");
  }

  double read_cell(std::size_t i) {
    const CsvNumber number = parse_number(cells_[i].text, separator_ == ';');
    if (number.problem.empty()) return number.value;
    refuse(cells_[i].column,
           fmt::format("column '{}': '{}' {}", table_.header[i], cells_[i].text, number.problem),
           "write a finite number, or leave the row out");
    return kNoNumber;
  }

  std::string_view rest_;
  const CsvColumns& wanted_;
  std::string file_;
  DatasetReading& reading_;
  CsvTable table_;
  std::vector<bool> is_wanted_;
  std::vector<Cell> cells_;
  std::string_view line_;
  int number_ = 0;
  char separator_ = ',';
  std::size_t increasing_ = std::numeric_limits<std::size_t>::max();
  double last_ = kNoNumber;
  int said_ = 0;
  int unsaid_ = 0;
};

}  // namespace

CsvTable parse_csv(std::string_view text, const CsvColumns& wanted, const std::string& file,
                   DatasetReading& reading) {
  return Parser(text, wanted, file, reading).parse();
}

}  // namespace flexspline::data
