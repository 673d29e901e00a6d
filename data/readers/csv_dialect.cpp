#include "readers/csv_dialect.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "flexspline/core/units.hpp"
#include "readers/cell_text.hpp"

namespace flexspline::data {
namespace {

std::string_view trimmed(std::string_view text) {
  const auto from = text.find_first_not_of(" \t\r");
  if (from == text.npos) return {};
  return text.substr(from, text.find_last_not_of(" \t\r") - from + 1);
}

bool is_digit(char letter) { return std::isdigit(static_cast<unsigned char>(letter)) != 0; }

bool is_comment(std::string_view line) {
  return line.starts_with('#') || line.starts_with('%') || line.starts_with("//");
}

/// Neither letters nor quotes but those of an exponent: numbers and what separates them.
bool is_of_numbers(std::string_view line) {
  return std::ranges::any_of(line, is_digit) &&
         line.find_first_not_of("0123456789.,;+-eE \t\r") == line.npos;
}

/// 2024-05-03, 03.05.2024, 5/3/2024, 12:30:01.5
bool is_date(std::string_view cell) {
  if (cell.size() < 5 || !is_digit(cell.front())) return false;
  const auto many = [&](char mark) { return std::ranges::count(cell, mark) >= 2; };
  return many(':') || many('-') || many('/') || many('.');
}

}  // namespace

std::optional<Foreign> foreign_header(std::string_view line, std::size_t cells) {
  line = trimmed(line);
  if (is_comment(line)) {
    return Foreign{fmt::format("the first line is a comment, '{}'", shown(line)),
                   "delete the lines above the names of the columns, and a mark before the names"};
  }
  if (line.starts_with("sep=")) {
    return Foreign{"the first line is a spreadsheet's 'sep='", "delete it"};
  }
  if (is_of_numbers(line)) {
    return Foreign{fmt::format("the first line holds numbers, '{}'", shown(line)),
                   "write a line with the names of the columns above it"};
  }
  if (cells == 1 && line.find_first_of(" \t") != line.npos) {
    return Foreign{fmt::format("the columns '{}' are separated by blanks", shown(line)),
                   "separate names and numbers by commas, semicolons or tabs"};
  }
  return std::nullopt;
}

std::optional<Foreign> foreign_row(std::string_view line, int number, bool any_number) {
  line = trimmed(line);
  if (is_comment(line)) {
    return Foreign{fmt::format("the line is a comment, '{}'", shown(line)), "delete it"};
  }
  if (number == 2 && !any_number) {
    return Foreign{fmt::format("the line below the header holds no numbers, '{}'", shown(line)),
                   "delete it; units are stated in [channels] of dataset.toml"};
  }
  return std::nullopt;
}

std::optional<std::string> foreign_cell(std::string_view cell) {
  if (is_date(cell)) return "is a date or time of day; write seconds since the first row";
  const auto letters = cell.find_first_not_of("0123456789.,+-eE ");
  if (letters == 0 || letters == cell.npos) return std::nullopt;
  if (!find_unit(trimmed(cell.substr(letters)))) return std::nullopt;
  return "carries its unit; write the number alone, and the unit into [channels] of dataset.toml";
}

}  // namespace flexspline::data
