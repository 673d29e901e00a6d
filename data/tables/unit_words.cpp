#include "tables/unit_words.hpp"

#include <algorithm>
#include <array>
#include <cctype>

#include "tables/text_cell.hpp"

namespace flexspline::data {
namespace {

constexpr std::pair<std::string_view, std::string_view> kWords[] = {
    {"grad", "deg"},        {"degree", "deg"},      {"degrees", "deg"},  {"radian", "rad"},
    {"radians", "rad"},     {"sek", "s"},           {"sekunden", "s"},   {"seconds", "s"},
    {"second", "s"},        {"msec", "ms"},         {"millisec", "ms"},  {"milliseconds", "ms"},
    {"usec", "us"},         {"microseconds", "us"}, {"u/min", "rpm"},    {"umdr", "rev"},
    {"revolutions", "rev"}, {"turns", "rev"},       {"grad/s", "deg/s"}, {"newtonmeter", "Nm"},
    {"amp", "A"},           {"ampere", "A"},        {"amps", "A"},       {"volt", "V"},
    {"volts", "V"},         {"newton", "N"},        {"celsius", "degC"}, {"kelvin", "K"},
    {"percent", "%"},       {"counts", "counts"},   {"ticks", "counts"}, {"inc", "counts"},
    {"incr", "counts"},     {"minutes", "min"},     {"hours", "h"},      {"boolean", "1"},
    {"bool", "1"},          {"none", "1"},          {"-", "1"},          {"n·m", "Nm"},
    {"newton meter", "Nm"}, {"newton metre", "Nm"}, {"deg c", "degC"},   {"n.mm", "Nmm"},
    {"deg", "deg"},         {"rad", "rad"},         {"rpm", "rpm"},      {"c", "degC"},
};

std::string lower(std::string_view text) {
  std::string result(text);
  std::ranges::transform(result, result.begin(), [](unsigned char letter) {
    return static_cast<char>(std::tolower(letter));
  });
  return result;
}

std::string_view without_brackets(std::string_view word) {
  word = bare_cell(word);
  static constexpr std::array<std::string_view, 4> pairs = {"[]", "()", "{}", "<>"};
  for (const std::string_view pair : pairs) {
    if (word.size() >= 2 && word.front() == pair[0] && word.back() == pair[1]) {
      return bare_cell(word.substr(1, word.size() - 2));
    }
  }
  return word;
}

std::optional<NameAndUnit> in_brackets(std::string_view text) {
  static constexpr std::array<std::string_view, 4> pairs = {"[]", "()", "{}", "<>"};
  for (const std::string_view pair : pairs) {
    if (!text.ends_with(pair[1])) continue;
    const auto open = text.rfind(pair[0]);
    if (open == text.npos || open == 0) continue;
    const std::string_view unit = text.substr(open + 1, text.size() - open - 2);
    // f(x) is a name; tau (Nm) and Zeit[s] are not.
    if (pair[0] == '(' && !unit_of_word(unit)) continue;
    return NameAndUnit{std::string(bare_cell(text.substr(0, open))), std::string(bare_cell(unit))};
  }
  return std::nullopt;
}

/// One letter behind a '_' is an index: theta_m is no length.
std::optional<NameAndUnit> behind_mark(std::string_view text) {
  for (const std::string_view mark : {"/", " in ", "_"}) {
    const auto at = text.find(mark);  // from the first: rad/s
    for (auto from = at; from != text.npos && from > 0; from = text.find(mark, from + 1)) {
      const std::string_view unit = text.substr(from + mark.size());
      const bool index = mark == "_" && (unit.size() < 2 || unit == "in" || unit == "min");
      if (!index && unit_of_word(unit)) {
        return NameAndUnit{std::string(bare_cell(text.substr(0, from))), std::string(unit)};
      }
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<Unit> unit_of_word(std::string_view word) {
  word = without_brackets(word);
  if (word.empty()) return std::nullopt;
  if (const auto unit = find_unit(word)) return unit;
  using Word = std::pair<std::string_view, std::string_view>;
  const std::string small = lower(word);
  const auto* found = std::ranges::find(kWords, small, &Word::first);
  if (found == std::end(kWords)) return std::nullopt;
  if (found->second == "counts") return Unit{"counts", Dimension::angle, 1.0, 0.0};
  return find_unit(found->second);
}

NameAndUnit split_name(std::string_view text) {
  text = bare_cell(text);
  if (auto found = in_brackets(text)) return *std::move(found);
  if (auto found = behind_mark(text)) return *std::move(found);
  const std::string small = lower(text);
  if (small == "t_s" || small == "time_s")
    return {std::string(text.substr(0, text.size() - 2)), "s"};
  return {std::string(text), ""};
}

}  // namespace flexspline::data
