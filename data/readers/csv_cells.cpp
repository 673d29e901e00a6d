#include "readers/csv_cells.hpp"

#include <algorithm>
#include <charconv>

namespace flexspline::data {
namespace {

constexpr std::string_view kBlank = " \t\r";

void drop_blanks(std::string_view line, std::size_t& from, std::size_t& to) {
  const auto is_blank = [&](std::size_t at) { return kBlank.find(line[at]) != kBlank.npos; };
  while (from < to && is_blank(from)) ++from;
  while (to > from && is_blank(to - 1)) --to;
}

/// One pair of quotes counts; further ones are of the text.
CsvCell trimmed(std::string_view line, std::size_t from, std::size_t to) {
  drop_blanks(line, from, to);
  const std::size_t column = from + 1;
  if (to - from >= 2 && line[from] == '"' && line[to - 1] == '"') drop_blanks(line, ++from, --to);
  return {line.substr(from, to - from), column};
}

/// Of a line that is read from its head to its end.
class PlainCells {
 public:
  explicit PlainCells(std::string_view line) : at_(line.data()), end_(at_ + line.size()) {}

  bool ended() const { return at_ == end_; }
  bool pass(char separator) { return at_ != end_ && *at_++ == separator; }
  void skip(char separator) { at_ = std::find(at_, end_, separator); }
  bool read(double& value) {
    skip_blanks();
    const auto [stop, code] = std::from_chars(at_, end_, value);
    at_ = stop;
    skip_blanks();
    return code == std::errc{};
  }

 private:
  void skip_blanks() {
    while (at_ != end_ && (*at_ == ' ' || *at_ == '\r')) ++at_;
  }

  const char* at_;
  const char* end_;
};

}  // namespace

void split_cells(std::string_view line, char separator, std::vector<CsvCell>& cells) {
  cells.clear();
  std::size_t from = 0;
  while (true) {
    const std::size_t to = std::min(line.find(separator, from), line.size());
    cells.push_back(trimmed(line, from, to));
    if (to == line.size()) return;
    from = to + 1;
  }
}

bool is_blank(std::string_view line) { return line.find_first_not_of(kBlank) == line.npos; }

bool read_plain_row(std::string_view line, char separator, const std::vector<std::size_t>& slots,
                    const std::vector<CsvColumn>& wanted, std::vector<double>& values) {
  PlainCells cells(line);
  for (std::size_t i = 0; i < slots.size(); ++i) {
    if (i > 0 && !cells.pass(separator)) return false;
    if (slots[i] == kNowhere) {
      cells.skip(separator);
      continue;
    }
    double& value = values[slots[i]];
    const CsvColumn& column = wanted[slots[i]];
    if (!cells.read(value) || !(value >= column.low && value <= column.high)) return false;
  }
  return cells.ended();
}

}  // namespace flexspline::data
