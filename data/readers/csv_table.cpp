#include "readers/csv_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "flexspline/core/nearest_name.hpp"
#include "readers/cell_text.hpp"
#include "readers/csv_cells.hpp"
#include "readers/csv_dialect.hpp"
#include "readers/csv_number.hpp"
#include "readers/line_source.hpp"

namespace flexspline::data {
namespace {

constexpr int kMostFindings = 20;
constexpr std::size_t kMostColumns = 4096;
constexpr std::size_t kMostRows = 100'000'000;

/// Reads one file; its state is the line at hand.
class Parser {
 public:
  Parser(LineSource& lines, const std::vector<CsvColumn>& wanted, std::string file,
         DatasetReading& reading)
      : lines_(lines), wanted_(wanted), file_(std::move(file)), reading_(reading) {}

  CsvTable parse() {
    if (read_header()) read_rows();
    if (!lines_.problem().empty()) {
      refuse(1, "reading stopped here: " + lines_.problem(), "check the disk");
    }
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

  void note(std::string problem, std::string remedy) {
    reading_.notes.push_back({file_, 1, 1, std::move(problem), std::move(remedy)});
  }

  /// False at the end, and where nothing can be read any more.
  bool next_line() {
    const auto line = lines_.next();
    if (!line) return false;
    ++number_;
    line_ = *line;
    if (lines_.is_cut()) {
      refuse(1, fmt::format("the line is longer than {} bytes", LineSource::kLongestLine),
             "write a row a line, and end each line");
      return false;
    }
    return true;
  }

  bool read_header() {
    const bool any = next_line();
    number_ = 1;
    if (any && line_.starts_with("\xEF\xBB\xBF")) line_.remove_prefix(3);
    if (lines_.is_cut()) return false;
    if (!any || is_blank(line_)) {
      refuse(1, "the table has no header", "name the columns on the first line");
      return false;
    }
    if (!is_text()) return false;
    choose_separator();
    split_cells(line_, separator_, cells_);
    if (cells_.size() > kMostColumns) {
      refuse(1, fmt::format("{} columns, where {} are the most", cells_.size(), kMostColumns),
             "write a table with the channels alone");
      return false;
    }
    for (const CsvCell& cell : cells_) add_column(cell);
    return find_wanted();
  }

  bool is_text() {
    if (line_.starts_with("\xFF\xFE") || line_.starts_with("\xFE\xFF")) {
      refuse(1, "the table is UTF-16", "save it as UTF-8");
    } else if (const auto zero = line_.find('\0'); zero != line_.npos) {
      refuse(zero + 1, "the table holds NUL bytes: it is UTF-16 or no text at all",
             "save it as CSV in UTF-8");
    } else if (const auto cr = line_.find('\r'); cr < line_.size() - 1) {
      refuse(cr + 1, "the lines end with CR alone", "save the table with LF or CRLF");
    } else {
      if (!is_utf8(line_)) note("the header is not UTF-8", "it is read as Latin-1; save as UTF-8");
      return true;
    }
    return false;
  }

  void choose_separator() {
    for (const char candidate : {';', ',', '\t'}) {
      if (line_.find(candidate) == line_.npos) continue;
      separator_ = candidate;
      break;
    }
    if (separator_ != ';') return;
    note("the columns are separated by semicolons",
         "numbers are read with a decimal comma or point");
  }

  void add_column(const CsvCell& cell) {
    std::string name = is_utf8(cell.text) ? std::string(cell.text) : utf8_of_latin1(cell.text);
    table_.header.push_back(std::move(name));
  }

  /// False where the header is foreign as a whole.
  bool find_wanted() {
    slots_.assign(table_.header.size(), kNowhere);
    place_.assign(wanted_.size(), kNowhere);
    table_.columns.resize(wanted_.size());
    for (std::size_t w = 0; w < wanted_.size(); ++w) {
      const auto found = std::ranges::find(table_.header, wanted_[w].name);
      if (found == table_.header.end()) continue;
      place_[w] = static_cast<std::size_t>(found - table_.header.begin());
      slots_[place_[w]] = w;
      if (wanted_[w].role == CsvRole::increasing) increasing_ = w;
      if (wanted_[w].role == CsvRole::valid) valid_ = w;
    }
    values_.resize(wanted_.size());
    const bool complete = std::ranges::find(place_, kNowhere) == place_.end();
    if (const auto foreign = complete ? std::nullopt : foreign_header(line_, cells_.size())) {
      refuse(1, foreign->problem, foreign->remedy);
      return false;
    }
    refuse_twins();
    refuse_missing();
    return true;
  }

  void refuse_twins() {
    for (std::size_t i = 1; i < table_.header.size(); ++i) {
      const auto here = table_.header.begin() + static_cast<std::ptrdiff_t>(i);
      if (std::find(table_.header.begin(), here, *here) == here) continue;
      refuse(cells_[i].column, fmt::format("column '{}' stands here twice", shown(*here)),
             "give each column a name of its own");
    }
  }

  void refuse_missing() {
    const std::vector<std::string_view> header(table_.header.begin(), table_.header.end());
    for (std::size_t w = 0; w < wanted_.size(); ++w) {
      if (place_[w] != kNowhere) continue;
      refuse(1, fmt::format("no column '{}', {}", wanted_[w].name, wanted_[w].named),
             suggestion(wanted_[w].name, header));
    }
  }

  void read_rows() {
    int first_blank = 0;
    while (!stopped_ && next_line()) {
      if (is_blank(line_)) {
        if (first_blank == 0) first_blank = number_;
        continue;
      }
      if (first_blank > 0) refuse_blank(std::exchange(first_blank, 0));
      if (table_.rows == kMostRows) {
        refuse(1, fmt::format("more than {} rows", kMostRows), "cut the recording, or thin it");
        return;
      }
      if (table_.rows == 0) reserve();
      ++table_.rows;
      if (!read_row_fast()) read_row();
      for (std::size_t w = 0; w < values_.size(); ++w) table_.columns[w].push_back(values_[w]);
    }
  }

  void reserve() {
    const std::size_t lines = lines_.file_bytes() / (line_.size() + 1) + 1;
    for (auto& column : table_.columns) column.reserve(std::min(lines, kMostRows));
  }

  /// Empty lines are for the end alone.
  void refuse_blank(int number) {
    const int here = std::exchange(number_, number);
    refuse(1, "the line is empty, and rows follow it", "delete it");
    number_ = here;
  }

  bool read_row_fast() {
    std::string_view line = line_;
    if (separator_ == ';' && line.find(',') != line.npos) {
      with_points_.assign(line);
      std::ranges::replace(with_points_, ',', '.');
      line = with_points_;
    }
    return read_plain_row(line, separator_, slots_, wanted_, values_) && holds_roles();
  }

  /// Time that increases; flags that are 0 or 1.
  bool holds_roles() {
    for (std::size_t w = 0; w < values_.size(); ++w) {
      const bool flag = wanted_[w].role == CsvRole::flag || wanted_[w].role == CsvRole::valid;
      if (flag && values_[w] != 0.0 && values_[w] != 1.0) return false;
    }
    if (increasing_ == kNowhere) return true;
    if (values_[increasing_] <= last_) return false;
    last_ = values_[increasing_];
    return true;
  }

  void read_row() {
    std::ranges::fill(values_, kNoNumber);
    split_cells(line_, separator_, cells_);
    if (is_foreign()) return;
    if (cells_.size() != table_.header.size()) {
      refuse_ragged();
      return;
    }
    const bool spoiled = valid_ != kNowhere && number_in(valid_).value == 0.0;
    for (std::size_t w = 0; w < values_.size() && !stopped_; ++w) {
      if (place_[w] != kNowhere) values_[w] = read_cell(w, spoiled);
    }
    if (increasing_ != kNowhere) check_increase(values_[increasing_]);
  }

  const CsvCell& cell_of(std::size_t wanted) const { return cells_[place_[wanted]]; }

  CsvNumber number_in(std::size_t wanted) const {
    return parse_number(cell_of(wanted).text, separator_ == ';');
  }

  bool is_foreign() {
    const bool any_number = std::ranges::any_of(cells_, [&](const CsvCell& cell) {
      return parse_number(cell.text, separator_ == ';').problem.empty();
    });
    const auto foreign = foreign_row(line_, number_, any_number);
    if (foreign) refuse(1, foreign->problem, foreign->remedy);
    return foreign.has_value();
  }

  /// Against the last value that could be read; a comparison with NaN never refuses.
  void check_increase(double value) {
    if (value <= last_) {
      refuse(cell_of(increasing_).column,
             fmt::format("column '{}' does not increase: {} after {}", wanted_[increasing_].name,
                         value, last_),
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

  /// The number, or NaN: refused, unless the row is marked as spoiled and the cell a dropout.
  double read_cell(std::size_t w, bool spoiled) {
    const CsvColumn& column = wanted_[w];
    const CsvNumber number = number_in(w);
    const bool implausible =
        number.problem.empty() && !(number.value >= column.low && number.value <= column.high);
    const bool may_drop_out = spoiled && column.role == CsvRole::value;
    if (may_drop_out && (number.absent || implausible)) return kNoNumber;
    if (!number.problem.empty()) {
      refuse_cell(w, number);
    } else if (implausible) {
      refuse(cell_of(w).column,
             fmt::format("column '{}': {} is implausible: {}", column.name, shown(cell_of(w).text),
                         column.limit),
             "correct the cell or the unit, or mark the row by a channel valid = 0");
    } else if (is_flag(column) && number.value != 0.0 && number.value != 1.0) {
      refuse(cell_of(w).column,
             fmt::format("column '{}': {} is neither 0 nor 1", column.name, shown(cell_of(w).text)),
             "write 1 for yes and 0 for no");
    } else {
      return number.value;
    }
    return kNoNumber;
  }

  static bool is_flag(const CsvColumn& column) {
    return column.role == CsvRole::flag || column.role == CsvRole::valid;
  }

  void refuse_cell(std::size_t w, const CsvNumber& number) {
    const CsvCell& cell = cell_of(w);
    const auto foreign = foreign_cell(cell.text);
    stopped_ = foreign.has_value();  // it is so in every row
    refuse(
        cell.column,
        fmt::format("column '{}': '{}' {}", wanted_[w].name, shown(cell.text),
                    foreign ? std::string_view(*foreign) : number.problem),
        foreign ? "" : "write a finite number, leave the row out, or mark it by a channel valid");
  }

  LineSource& lines_;
  const std::vector<CsvColumn>& wanted_;
  std::string file_;
  DatasetReading& reading_;
  CsvTable table_;
  std::vector<std::size_t> slots_;  ///< by column of the file: which of the wanted it is
  std::vector<std::size_t> place_;  ///< by wanted: which column of the file it is
  std::vector<double> values_;      ///< of the row at hand, by wanted
  std::vector<CsvCell> cells_;
  std::string_view line_;
  std::string with_points_;
  int number_ = 0;
  char separator_ = ',';
  std::size_t increasing_ = kNowhere;
  std::size_t valid_ = kNowhere;
  double last_ = kNoNumber;
  bool stopped_ = false;
  int said_ = 0;
  int unsaid_ = 0;
};

}  // namespace

CsvTable read_csv(const std::filesystem::path& file, const std::vector<CsvColumn>& wanted,
                  DatasetReading& reading) {
  auto lines = LineSource::open(file);
  if (lines) return Parser(*lines, wanted, file.string(), reading).parse();
  reading.errors.push_back({file.string(), 0, 0, lines.error().problem, lines.error().remedy});
  return {};
}

}  // namespace flexspline::data
