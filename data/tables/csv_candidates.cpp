#include "tables/csv_candidates.hpp"

#include <algorithm>
#include <map>
#include <tuple>

#include "tables/csv_form.hpp"
#include "tables/time_stamp.hpp"

namespace flexspline::data {
namespace {

using Lines = std::vector<std::string_view>;
using Cells = std::vector<std::string_view>;

bool is_blank(std::string_view line) { return line.find_first_not_of(" \t\r") == line.npos; }

struct LineLook {
  std::size_t cells = 0;
  std::size_t numbers = 0;  ///< and time stamps
  std::size_t nothing = 0;
  bool labelled = false;  ///< its first cell is a word

  bool is_row() const { return numbers > 0 && 2 * (numbers + nothing) > cells; }
};

LineLook look_at(std::string_view line, const CsvCandidate& form, Cells& cells) {
  LineLook look;
  if (is_blank(line) || is_comment_line(line)) return look;
  split_text(line, form.delimiter, cells);
  look.cells = cells.size();
  for (const std::string_view& cell : cells) {
    const std::string_view bare = bare_cell(cell);
    if (is_nothing(bare)) {
      ++look.nothing;
    } else if (text_number(bare, form.numbers) || parse_time_stamp(bare)) {
      ++look.numbers;
    } else if (&cell == &cells.front()) {
      look.labelled = true;
    }
  }
  return look;
}

bool is_row(const LineLook& look, std::size_t cells) {
  return look.is_row() && look.cells == cells;
}

/// The first row that has another soon after it; behind the last line where there is none.
std::size_t first_row(const std::vector<LineLook>& looks, std::size_t cells) {
  constexpr std::size_t kSoon = 4;
  std::optional<std::size_t> last;
  for (std::size_t i = 0; i < looks.size(); ++i) {
    if (!is_row(looks[i], cells)) continue;
    if (last && i - *last < kSoon) return *last;
    last = i;
  }
  return looks.size();
}

/// Rows without a label below a few that have one: those say what the file is.
std::size_t below_labels(const std::vector<LineLook>& looks, std::size_t first, std::size_t cells) {
  constexpr std::size_t kMostLines = 64;
  constexpr std::size_t kInARow = 4;
  if (first >= looks.size() || !looks[first].labelled) return first;
  std::size_t plain = 0;
  for (std::size_t i = first; i < std::min(looks.size(), first + kMostLines); ++i) {
    plain = is_row(looks[i], cells) && !looks[i].labelled ? plain + 1 : 0;
    if (plain == kInARow) return i + 1 - kInARow;
  }
  return first;
}

/// Rows are lines of numbers with as many cells as most of them have.
CsvCandidate judged(const Lines& lines, CsvCandidate form) {
  std::vector<LineLook> looks;
  Cells cells;
  std::map<std::size_t, std::size_t> widths;
  for (const std::string_view line : lines) {
    looks.push_back(look_at(line, form, cells));
    if (looks.back().is_row()) ++widths[looks.back().cells];
  }
  if (widths.empty()) return form;
  form.cells =
      std::ranges::max_element(widths, {}, [](const auto& one) { return one.second; })->first;
  form.first = below_labels(looks, first_row(looks, form.cells), form.cells);
  std::size_t known = 0;
  std::size_t filled = 0;
  for (std::size_t i = form.first; i < looks.size(); ++i) {
    filled += looks[i].cells > 0 ? 1 : 0;
    if (!is_row(looks[i], form.cells)) continue;
    ++form.rows;
    known += looks[i].numbers + looks[i].nothing;
  }
  if (form.rows > 0) {
    form.share = static_cast<double>(known) / static_cast<double>(filled * form.cells);
  }
  return form;
}

bool header_agrees(const Lines& lines, const CsvCandidate& form) {
  Cells cells;
  for (std::size_t i = form.first; i-- > 0;) {
    if (is_blank(lines[i])) continue;
    split_text(lines[i], form.delimiter, cells);
    return cells.size() == form.cells;
  }
  return form.first == 0;
}

}  // namespace

std::optional<CsvCandidate> best_candidate(const Lines& lines, const TextForm& stated) {
  constexpr std::string_view kDelimiters = ";\t,| ";
  std::optional<CsvCandidate> best;
  std::tuple<double, bool, std::size_t> best_score;
  for (const bool grouped : {false, true}) {
    for (const char delimiter : kDelimiters) {
      for (const char decimal : {'.', ','}) {
        if (stated.delimiter != 0 && stated.delimiter != delimiter) continue;
        if (stated.decimal != 0 && stated.decimal != decimal) continue;
        const CsvCandidate one = judged(lines, {delimiter, {decimal, grouped}});
        if (one.rows == 0) continue;
        const std::tuple score(one.share, header_agrees(lines, one), one.cells);
        const bool better =
            !best || (grouped ? std::get<0>(score) > std::get<0>(best_score) : score > best_score);
        if (!better) continue;
        best = one;
        best_score = score;
      }
    }
  }
  return best;
}

bool is_open(const Lines& lines, const CsvCandidate& candidate) {
  const char mark = candidate.numbers.decimal;
  const char other = mark == '.' ? ',' : '.';
  if (candidate.delimiter == mark || candidate.numbers.grouped) return false;
  std::vector<bool> with(candidate.cells), without(candidate.cells);
  Cells cells;
  for (std::size_t i = candidate.first; i < lines.size(); ++i) {
    split_text(lines[i], candidate.delimiter, cells);
    for (std::size_t k = 0; k < std::min(cells.size(), candidate.cells); ++k) {
      const std::string_view bare = bare_cell(cells[k]);
      if (!text_number(bare, candidate.numbers)) continue;
      const bool marked = bare.find(mark) != bare.npos;
      if (marked && !is_grouped(bare, other)) return false;
      (marked ? with : without)[k] = true;
    }
  }
  for (std::size_t k = 0; k < candidate.cells; ++k) {
    if (with[k] && without[k]) return true;
  }
  return false;
}

}  // namespace flexspline::data
