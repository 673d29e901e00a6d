#include "tables/csv_rows.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "readers/cell_text.hpp"

namespace flexspline::data {
namespace {

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kBlockRows = 4096;
constexpr double kDay = 86400.0;
constexpr std::size_t kNowhere = static_cast<std::size_t>(-1);

/// Only what numbers are written with: digits, marks, signs, an exponent.
bool looks_like_number(std::string_view bare) {
  return bare.find_first_of("0123456789") != bare.npos &&
         bare.find_first_not_of("0123456789.,'+-eE ") == bare.npos;
}

bool is_blank(char letter) { return letter == ' ' || letter == '\t' || letter == '\r'; }

}  // namespace

void CsvRows::Incident::add(std::size_t at, std::string_view what) {
  if (count++ > 0) return;
  line = at;
  text = shown(what);
}

CsvRows::CsvRows(const CsvForm& form, const std::vector<std::size_t>& wanted, std::string file,
                 TableSink& sink)
    : form_(form), name_(std::move(file)), sink_(sink), numbers_(form.numbers) {
  slots_.assign(form_.names.size(), kNowhere);
  for (std::size_t w = 0; w < wanted.size(); ++w) slots_[wanted[w]] = w;
  block_.assign(wanted.size(), std::vector<double>(kBlockRows));
  last_stamp_.assign(form_.names.size(), -std::numeric_limits<double>::infinity());
  plain_ = std::ranges::none_of(form_.kinds, [](CellKind kind) { return kind == CellKind::stamp; });
  unread_.resize(form_.names.size());
}

void CsvRows::use(const NumberForm& numbers) {
  numbers_ = numbers;
  fast_ = plain_ && numbers_.decimal == '.' && !numbers_.grouped;
}

Result<void> CsvRows::take(std::string_view line, std::size_t number, bool last) {
  line_ = number, last_ = last;
  if (!fast_ || !read_fast(line)) return read_slowly(line);
  took_row();
  return {};
}

tl::unexpected<Error> CsvRows::refused_at(std::size_t line, const std::string& problem,
                                          const std::string& remedy) const {
  return failure(ErrorCode::bad_data, fmt::format("{}:{}: {}", name_, line, problem), remedy);
}

void CsvRows::took_row() {
  if (++filled_ == kBlockRows) flush();
}

void CsvRows::flush() {
  if (filled_ == 0) return;
  for (auto& column : block_) column.resize(filled_);
  sink_.rows(block_);
  for (auto& column : block_) column.resize(kBlockRows);
  rows_ += std::exchange(filled_, 0);
}

bool CsvRows::read_fast(std::string_view line) {
  const char* at = line.data();
  const char* const end = at + line.size();
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    if (i > 0 && form_.delimiter != ' ' && (at == end || *at++ != form_.delimiter)) return false;
    const auto skip = [&] {
      while (at != end && is_blank(*at) && *at != form_.delimiter) ++at;
      if (form_.delimiter == ' ') {
        while (at != end && is_blank(*at)) ++at;
      }
    };
    skip();
    if (slots_[i] == kNowhere) {
      while (at != end && *at != form_.delimiter) {
        if (*at++ == '"') return false;
      }
      continue;
    }
    double value = 0.0;
    const auto [stop, code] = std::from_chars(at, end, value);
    if (code != std::errc{}) return false;
    at = stop;
    if (form_.delimiter == ' ' && at != end && !is_blank(*at)) return false;
    skip();
    block_[slots_[i]][filled_] = std::isfinite(value) ? value : kNothing;
  }
  return at == end;
}

Result<void> CsvRows::read_slowly(std::string_view line) {
  if (line.find_first_not_of(" \t\r\f") == line.npos || is_comment_line(line)) return {};
  split_text(line, form_.delimiter, cells_);
  const std::size_t width = slots_.size();
  if (cells_.size() == width + 1 && bare_cell(cells_.back()).empty()) cells_.pop_back();
  if (cells_.size() != width) {
    ragged_.add(line_, line);
    return {};
  }
  bool any = false;
  for (std::size_t i = 0; i < width; ++i) {
    if (slots_[i] == kNowhere) {
      any = any || form_.kinds[i] != CellKind::text;
      continue;
    }
    const auto value = cell(i, bare_cell(cells_[i]));
    if (!value) return tl::unexpected(value.error());
    any = any || std::isfinite(*value) || bare_cell(cells_[i]).empty();
    block_[slots_[i]][filled_] = *value;
  }
  if (any) {
    took_row();
  } else {
    ragged_.add(line_, line);
  }
  return {};
}

Result<double> CsvRows::cell(std::size_t column, std::string_view bare) {
  if (is_nothing(bare)) return kNothing;
  if (form_.kinds[column] == CellKind::stamp) {
    if (const auto stamp = parse_time_stamp(bare)) return seconds(column, *stamp);
  } else if (const auto number = text_number(bare, numbers_)) {
    return *number;
  }
  if (form_.kinds[column] == CellKind::number && looks_like_number(bare) && !last_) {
    return refused_at(
        line_,
        fmt::format("column {} '{}': '{}' is no number with a decimal {}{}", column + 1,
                    shown(form_.names[column]), shown(bare),
                    form_.numbers.decimal == ',' ? "comma" : "point",
                    form_.numbers.grouped ? "" : " and no groups of digits"),
        "state how numbers are written by --decimal and --delimiter, or mend the line");
  }
  if (form_.kinds[column] != CellKind::text) unread_[column].add(line_, bare);
  return kNothing;
}

/// Since midnight of the first day; a time of day that falls by more than half a day is of the
/// next one.
double CsvRows::seconds(std::size_t column, const TimeStamp& stamp) {
  double value = stamp.second;
  if (stamp.day)
    value += kDay * static_cast<double>(*stamp.day - form_.first_day.value_or(*stamp.day));
  double& last = last_stamp_[column];
  if (!stamp.day && std::isfinite(last)) value += kDay * std::round((last - value) / kDay);
  return last = value;
}

Result<void> CsvRows::finish() {
  flush();
  const std::size_t bearable = std::max<std::size_t>(3, rows_ / 100);
  if (ragged_.count > bearable) {
    return refused_at(ragged_.line,
                      fmt::format("'{}' is no row of {} cells, nor are {} other lines",
                                  ragged_.text, slots_.size(), ragged_.count - 1),
                      "give every row one cell a column");
  }
  if (ragged_.count > 0) {
    sink_.note(fmt::format("{} line{} left out that are no rows; the first is line {}, '{}'",
                           ragged_.count, ragged_.count == 1 ? "" : "s", ragged_.line,
                           ragged_.text));
  }
  for (std::size_t i = 0; i < unread_.size(); ++i) {
    if (unread_[i].count == 0) continue;
    sink_.note(fmt::format("column {} '{}': {} cells are no numbers; the first, '{}', on line {}",
                           i + 1, shown(form_.names[i]), unread_[i].count, unread_[i].text,
                           unread_[i].line));
  }
  return {};
}

}  // namespace flexspline::data
