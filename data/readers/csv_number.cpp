#include "readers/csv_number.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <string>

namespace flexspline::data {
namespace {

/// from_chars tells too large and too small alike; what is too small rounds to 0 as it should.
CsvNumber out_of_range(std::string_view cell) {
  const double value = std::strtod(std::string(cell).c_str(), nullptr);
  if (std::isinf(value)) return {kNoNumber, "is too large"};
  return {value, {}};
}

bool is_word_for_nothing(std::string_view cell) {
  static constexpr std::array<std::string_view, 5> words = {"NA", "N/A", "#N/A", "null", "NULL"};
  return std::ranges::find(words, cell) != words.end();
}

CsvNumber parse_with_point(std::string_view cell) {
  std::string_view digits = cell;
  if (digits.starts_with('+') && !digits.starts_with("+-")) digits.remove_prefix(1);
  if (digits.empty()) return {kNoNumber, "is empty", true};
  if (is_word_for_nothing(digits)) return {kNoNumber, "is not a number", true};
  double value = kNoNumber;
  const char* end = digits.data() + digits.size();
  const auto [stop, code] = std::from_chars(digits.data(), end, value);
  if (code == std::errc::invalid_argument || stop != end) return {kNoNumber, "is not a number"};
  if (code == std::errc::result_out_of_range) return out_of_range(digits);
  if (!std::isfinite(value)) return {kNoNumber, "is not finite", true};
  return {value, {}};
}

}  // namespace

CsvNumber parse_number(std::string_view cell, bool decimal_comma) {
  if (!decimal_comma || cell.find(',') == cell.npos) return parse_with_point(cell);
  std::string with_point(cell);
  std::ranges::replace(with_point, ',', '.');
  return parse_with_point(with_point);
}

}  // namespace flexspline::data
