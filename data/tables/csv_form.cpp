#include "tables/csv_form.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "readers/cell_text.hpp"
#include "tables/csv_candidates.hpp"
#include "tables/time_stamp.hpp"
#include "tables/unit_words.hpp"

namespace flexspline::data {
namespace {

using Lines = std::vector<std::string_view>;
using Cells = std::vector<std::string_view>;

Lines lines_of(std::string_view text, char end, bool whole) {
  Lines lines;
  for (std::size_t from = 0; from < text.size();) {
    const std::size_t to = text.find(end, from);
    if (to == text.npos) {
      if (whole) lines.push_back(text.substr(from));
      break;
    }
    lines.push_back(text.substr(from, to - from));
    from = to + 1;
  }
  return lines;
}

std::string_view without_comment_mark(std::string_view line) {
  if (!is_comment_line(line)) return line;
  const auto from = line.find_first_not_of("#%/; \t");
  return from == line.npos ? std::string_view{} : line.substr(from);
}

bool is_unit_row(const Cells& cells) {
  std::size_t units = 0;
  for (const std::string_view cell : cells) {
    const std::string_view bare = bare_cell(cell);
    if (bare.empty() || bare == "[]" || bare == "()") continue;
    if (!unit_of_word(bare)) return false;
    ++units;
  }
  return units > 0;
}

std::string word_of(char mark) {
  switch (mark) {
    case '\t':
      return "tabs";
    case ' ':
      return "blanks";
    default:
      return fmt::format("'{}'", mark);
  }
}

/// Finds the names and units above the rows, and what each column holds.
class Header {
 public:
  Header(const Lines& lines, const CsvCandidate& rows, const TextForm& stated, CsvForm& form)
      : lines_(lines), rows_(rows), stated_(stated), form_(form) {}

  Result<void> find() {
    form_.names.assign(rows_.cells, "");
    form_.units.assign(rows_.cells, "");
    find_lines();
    if (names_ == kNone && stated_.header_line > 0) {
      return failure(ErrorCode::bad_data,
                     fmt::format("line {} has no {} names", stated_.header_line, rows_.cells),
                     "give the line of the columns' names to --header-line");
    }
    if (names_ == kNone && has_half_as_many()) {
      return failure(ErrorCode::bad_data,
                     fmt::format("line {}: {} cells below half as many names: numbers seem to have "
                                 "a decimal comma, and columns are separated by commas, too",
                                 rows_.first + 1, rows_.cells),
                     "export it with ; between the columns, or with decimal points");
    }
    if (names_ != kNone) take(names_, form_.names);
    const std::size_t labelled = names_ == kNone || units_ != kNone ? kNone : labelled_units();
    if (labelled != kNone) units_ = labelled;
    if (units_ != kNone) take(units_, form_.units);
    if (labelled != kNone) form_.units[0].clear();
    name_the_nameless();
    find_kinds();
    say();
    return {};
  }

 private:
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  /// Cells of a line as wide as the rows; an empty one at the end aside.
  bool fits(std::size_t line, Cells& cells) const {
    split_text(without_comment_mark(lines_[line]), form_.delimiter, cells);
    if (cells.size() == rows_.cells + 1 && bare_cell(cells.back()).empty()) cells.pop_back();
    return cells.size() == rows_.cells || cells.size() + 1 == rows_.cells;
  }

  void find_lines() {
    Cells cells;
    if (stated_.header_line > 0) {
      const auto line = static_cast<std::size_t>(stated_.header_line) - 1;
      if (line >= rows_.first || !fits(line, cells)) return;
      names_ = line;
      if (line + 1 < rows_.first && fits(line + 1, cells) && is_unit_row(cells)) units_ = line + 1;
      return;
    }
    for (std::size_t i = rows_.first; i-- > 0 && names_ == kNone;) {
      if (bare_cell(lines_[i]).empty()) continue;
      if (!fits(i, cells)) break;
      if (units_ == kNone && i > 0 && is_unit_row(cells) && has_names_above(i)) {
        units_ = i;
      } else {
        names_ = i;
      }
    }
  }

  /// A line far above that says it has the units: "Y_Unit_Label", "Einheit".
  std::size_t labelled_units() const {
    Cells cells;
    for (std::size_t i = 0; i < names_; ++i) {
      if (!fits(i, cells) || cells.size() < 2) continue;
      const std::string_view label = bare_cell(cells[0]);
      const bool says = label.find("Unit") != label.npos || label.find("unit") != label.npos ||
                        label.find("Einheit") != label.npos;
      if (says && is_unit_row({cells.begin() + 1, cells.end()})) return i;
    }
    return kNone;
  }

  bool has_names_above(std::size_t line) const {
    Cells cells;
    return fits(line - 1, cells) && !bare_cell(lines_[line - 1]).empty();
  }

  bool has_half_as_many() const {
    if (rows_.first == 0 || form_.delimiter != ',' || rows_.cells % 2 != 0) return false;
    Cells cells;
    split_text(lines_[rows_.first - 1], form_.delimiter, cells);
    return 2 * cells.size() == rows_.cells;
  }

  void take(std::size_t line, std::vector<std::string>& to) const {
    Cells cells;
    fits(line, cells);
    const std::size_t from = cells.size() < rows_.cells && !ends_empty() ? 1 : 0;
    for (std::size_t i = 0; i < cells.size(); ++i) to[from + i] = bare_cell(cells[i]);
  }

  /// One name fewer than cells: the rows end with a delimiter, or they begin with their number.
  bool ends_empty() const {
    Cells cells;
    split_text(lines_[rows_.first], form_.delimiter, cells);
    return bare_cell(cells.back()).empty();
  }

  void name_the_nameless() {
    for (std::size_t i = 0; i < rows_.cells; ++i) {
      if (form_.names[i].empty()) form_.names[i] = fmt::format("column {}", i + 1);
    }
  }

  void find_kinds() {
    std::vector<std::array<std::size_t, 3>> seen(rows_.cells);
    Cells cells;
    for (std::size_t i = rows_.first; i < lines_.size(); ++i) {
      if (is_comment_line(lines_[i])) continue;
      split_text(lines_[i], form_.delimiter, cells);
      if (cells.size() != rows_.cells) continue;
      for (std::size_t k = 0; k < cells.size(); ++k) count(bare_cell(cells[k]), seen[k]);
    }
    form_.kinds.clear();
    for (const auto& [numbers, stamps, texts] : seen) {
      form_.kinds.push_back(stamps > numbers               ? CellKind::stamp
                            : texts > numbers && texts > 0 ? CellKind::text
                                                           : CellKind::number);
    }
  }

  void count(std::string_view bare, std::array<std::size_t, 3>& seen) {
    if (is_nothing(bare)) return;
    if (text_number(bare, form_.numbers)) {
      ++seen[0];
    } else if (const auto stamp = parse_time_stamp(bare)) {
      ++seen[1];
      if (stamp->day && !form_.first_day) form_.first_day = stamp->day;
      order_open_ = order_open_ || stamp->order_open;
    } else {
      ++seen[2];
    }
  }

  void say() const {
    auto& notes = form_.notes;
    notes.push_back(fmt::format(
        "text in {}{}, columns separated by {}, decimal {}{}", name_of(form_.encoding.encoding),
        form_.encoding.mark_bytes > 0 ? " with a byte-order mark" : "", word_of(form_.delimiter),
        form_.numbers.decimal == ',' ? "comma" : "point",
        form_.numbers.grouped ? ", digits in groups of three" : ""));
    if (names_ == kNone) {
      notes.push_back(fmt::format("no line names the {} columns", rows_.cells));
    } else {
      notes.push_back(fmt::format(
          "names on line {}{}, rows from line {}", names_ + 1,
          units_ == kNone ? "" : fmt::format(", units on line {}", units_ + 1), rows_.first + 1));
    }
    if (order_open_) {
      notes.emplace_back("dates are read as month/day/year; swapping them changes no time of day");
    }
    for (std::size_t i = 0; i < form_.kinds.size(); ++i) {
      if (form_.kinds[i] != CellKind::text) continue;
      notes.push_back(fmt::format("column {} '{}' is text", i + 1, shown(form_.names[i])));
    }
  }

  const Lines& lines_;
  const CsvCandidate& rows_;
  const TextForm& stated_;
  CsvForm& form_;
  std::size_t names_ = kNone;
  std::size_t units_ = kNone;
  bool order_open_ = false;
};

}  // namespace

bool is_comment_line(std::string_view line) {
  line = line.substr(std::min(line.find_first_not_of(" \t\""), line.size()));
  return line.starts_with('#') || line.starts_with('%') || line.starts_with("//") ||
         line.starts_with("; ");
}

Result<CsvForm> sniff_csv(std::string_view head, bool whole, const TextForm& stated) {
  CsvForm form;
  form.encoding = sniff_encoding(head);
  const std::string text = decoded(head.substr(form.encoding.mark_bytes), form.encoding.encoding);
  form.line_end = text.find('\n') == text.npos && text.find('\r') != text.npos ? '\r' : '\n';
  const Lines lines = lines_of(text, form.line_end, whole);
  TextForm known = stated;
  if (known.delimiter == 0 && !lines.empty() && lines[0].starts_with("sep=") &&
      lines[0].size() > 4) {
    known.delimiter = lines[0][4];
  }
  const auto best = best_candidate(lines, known);
  if (!best) {
    return failure(ErrorCode::bad_data, "no rows of numbers were found in the text",
                   "give a table: a line of names, and rows of numbers below it");
  }
  if (stated.decimal == 0 && is_open(lines, *best)) {
    return failure(
        ErrorCode::bad_data,
        fmt::format("'{}' may be the decimal mark or separate thousands", best->numbers.decimal),
        "state which by --decimal , or --decimal .");
  }
  form.delimiter = best->delimiter;
  form.numbers = best->numbers;
  form.first_line = best->first;
  if (auto found = Header(lines, *best, stated, form).find(); !found) {
    return tl::unexpected(found.error());
  }
  return form;
}

}  // namespace flexspline::data
