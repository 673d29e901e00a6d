#include "tables/text_cell.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <string>

namespace flexspline::data {
namespace {

constexpr std::string_view kBlank = " \t\r";

std::string_view trimmed(std::string_view text) {
  const auto from = text.find_first_not_of(kBlank);
  if (from == text.npos) return {};
  return text.substr(from, text.find_last_not_of(kBlank) - from + 1);
}

bool is_digit(char letter) { return letter >= '0' && letter <= '9'; }

std::optional<double> plain_number(std::string_view digits) {
  if (digits.starts_with('+') && !digits.starts_with("+-")) digits.remove_prefix(1);
  double value = 0.0;
  const char* end = digits.data() + digits.size();
  const auto [stop, code] = std::from_chars(digits.data(), end, value);
  if (stop != end || digits.empty() || code == std::errc::invalid_argument) return std::nullopt;
  if (code == std::errc::result_out_of_range) {
    value = std::strtod(std::string(digits).c_str(), nullptr);  // too small is 0
  }
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

void split_blanks(std::string_view line, std::vector<std::string_view>& cells) {
  for (std::size_t at = line.find_first_not_of(kBlank); at != line.npos;) {
    const std::size_t to = std::min(line.find_first_of(kBlank, at), line.size());
    cells.push_back(line.substr(at, to - at));
    at = line.find_first_not_of(kBlank, to);
  }
}

std::size_t cell_end(std::string_view line, std::size_t from, char delimiter) {
  const std::size_t start = line.find_first_not_of(' ', from);
  if (start != line.npos && line[start] == '"') {
    bool inside = false;
    for (std::size_t i = start; i < line.size(); ++i) {
      if (line[i] == '"') inside = !inside;
      if (line[i] == delimiter && !inside) return i;
    }
    if (!inside) return line.size();
  }
  return std::min(line.find(delimiter, from), line.size());
}

/// The sign and whole digits before the decimal mark or exponent.
std::string_view whole_part(std::string_view bare, char decimal) {
  if (!bare.empty() && (bare.front() == '-' || bare.front() == '+')) bare.remove_prefix(1);
  const auto stop = std::ranges::find_if(
      bare, [&](char letter) { return letter == decimal || letter == 'e' || letter == 'E'; });
  return bare.substr(0, static_cast<std::size_t>(stop - bare.begin()));
}

}  // namespace

std::string_view bare_cell(std::string_view cell) {
  cell = trimmed(cell);
  if (cell.size() >= 2 && (cell.front() == '"' || cell.front() == '\'') &&
      cell.back() == cell.front()) {
    cell = trimmed(cell.substr(1, cell.size() - 2));
  }
  return cell;
}

void split_text(std::string_view line, char delimiter, std::vector<std::string_view>& cells) {
  cells.clear();
  if (delimiter == ' ') return split_blanks(line, cells);
  for (std::size_t from = 0;;) {
    const std::size_t to = cell_end(line, from, delimiter);
    cells.push_back(line.substr(from, to - from));
    if (to == line.size()) return;
    from = to + 1;
  }
}

bool is_nothing(std::string_view bare) {
  static constexpr std::array<std::string_view, 15> words = {
      "nan",  "na",   "n/a",     "#n/a",   "#nv",     "null",     "none",     "inf",
      "-inf", "+inf", "#div/0!", "#wert!", "#value!", "infinity", "-infinity"};
  if (bare.empty() || bare.find_first_not_of('-') == bare.npos) return true;
  if (bare.size() > 10) return false;
  std::string lower(bare);
  std::ranges::transform(lower, lower.begin(), [](unsigned char letter) {
    return static_cast<char>(std::tolower(letter));
  });
  if (std::ranges::find(words, lower) != words.end()) return true;
  return lower == "-nan" || lower.starts_with("1.#") || lower.starts_with("-1.#") ||
         lower.starts_with("nan(");
}

bool is_grouped(std::string_view bare, char decimal) {
  const std::string_view whole = whole_part(bare, decimal);
  const auto first = std::ranges::find_if_not(whole, is_digit);
  if (first == whole.end()) return false;
  const char mark = *first;
  const auto lead = static_cast<std::size_t>(first - whole.begin());
  if (mark != ',' && mark != '.' && mark != '\'' && mark != ' ') return false;
  if (mark == decimal || lead == 0 || lead > 3 || whole.front() == '0') return false;
  for (std::size_t i = lead; i < whole.size(); i += 4) {
    if (whole[i] != mark || i + 3 >= whole.size()) return false;
    if (!std::ranges::all_of(whole.substr(i + 1, 3), is_digit)) return false;
  }
  return true;
}

std::optional<double> text_number(std::string_view bare, const NumberForm& form) {
  if (bare.empty() || bare.size() > 64) return std::nullopt;
  const bool groups = form.grouped && is_grouped(bare, form.decimal);
  if (!groups && form.decimal == '.') return plain_number(bare);
  if (!groups && bare.find('.') != bare.npos) return std::nullopt;
  std::string text;
  bool whole = true;
  for (const char letter : bare) {
    if (letter == form.decimal || letter == 'e' || letter == 'E') whole = false;
    if (groups && whole && !is_digit(letter) && letter != '-' && letter != '+') continue;
    text += letter == form.decimal ? '.' : letter;
  }
  return plain_number(text);
}

}  // namespace flexspline::data
