#include <cmath>

#include <fmt/format.h>

#include "config/study_source.hpp"

namespace flexspline::studies {
namespace {

constexpr std::int64_t kMostPoints = 10'000'000;

std::optional<SweepValue> value_of(const toml::node& node) {
  if (const auto* whole = node.as_integer()) return whole->get();
  if (const auto* number = node.as_floating_point()) {
    if (!std::isfinite(number->get())) return std::nullopt;
    return number->get();
  }
  if (const auto* flag = node.as_boolean()) return flag->get();
  if (const auto* word = node.as_string()) return word->get();
  return std::nullopt;
}

std::vector<SweepValue> listed(TomlSection& section) {
  const toml::node* node = section.node("values");
  const toml::array* list = node->as_array();
  std::vector<SweepValue> values;
  if (list == nullptr || list->empty()) {
    section.refuse("values", fmt::format("'{}' holds no value", section.name_of("values")),
                   "write values = [0.1, 0.2]");
    return values;
  }
  for (const toml::node& entry : *list) {
    if (const auto value = value_of(entry)) {
      values.push_back(*value);
    } else {
      section.refuse_at(entry, fmt::format("an entry of '{}' is neither a finite number nor a word",
                                           section.name_of("values")));
    }
  }
  return values;
}

/// from, to and count of a space; count 0 after a refusal.
struct Space {
  double from = 0.0;
  double to = 0.0;
  std::size_t count = 0;
  bool whole = false;  ///< its ends are whole numbers
};

Space read_space(TomlSection& section, std::string_view name) {
  auto own = section.table(name);
  if (!own) return {};
  Space space;
  const auto from = own->number("from");
  const auto to = own->number("to");
  if (!own->has("count")) {
    own->refuse("count", fmt::format("'{}' is missing", own->name_of("count")), "add count = 5");
  }
  const auto count = own->integer("count", 1, kMostPoints);
  own->refuse_unknown_keys();
  if (!from || !to || !count) return {};
  space = {*from, *to, static_cast<std::size_t>(*count),
           own->node("from")->is_integer() && own->node("to")->is_integer()};
  if (space.count > 1 && space.from == space.to) {
    own->refuse("to",
                fmt::format("'{}' is empty: it goes from {} to {}", section.name_of(name),
                            space.from, space.to),
                "give two different ends");
    return {};
  }
  if (name == "logspace" && !(space.from > 0.0 && space.to > 0.0)) {
    own->refuse("from",
                fmt::format("'{}' holds {} or {}, which has no logarithm", section.name_of(name),
                            space.from, space.to),
                "give two positive ends");
    return {};
  }
  return space;
}

std::vector<SweepValue> spaced(const Space& space, bool log) {
  std::vector<double> numbers;
  bool whole = space.whole;
  for (std::size_t i = 0; i < space.count; ++i) {
    const double u =
        space.count == 1 ? 0.0 : static_cast<double>(i) / static_cast<double>(space.count - 1);
    const bool last = i + 1 == space.count && i > 0;
    const double inner = log ? space.from * std::pow(space.to / space.from, u)
                             : space.from + u * (space.to - space.from);
    numbers.push_back(last ? space.to : inner);
    whole = whole && numbers.back() == std::round(numbers.back());
  }
  std::vector<SweepValue> values;
  for (const double number : numbers) {
    if (whole)
      values.emplace_back(static_cast<std::int64_t>(number));
    else
      values.emplace_back(number);
  }
  return values;
}

}  // namespace

std::vector<SweepValue> read_sweep_values(TomlSection& section, SweepKey& key) {
  key.path = section.required_text("key");
  key.unit = section.text("unit").value_or("");
  int given = 0;
  std::vector<SweepValue> values;
  if (section.has("values")) {
    ++given;
    values = listed(section);
  }
  for (const char* name : {"linspace", "logspace"}) {
    if (!section.has(name)) continue;
    ++given;
    values = spaced(read_space(section, name), std::string_view(name) == "logspace");
  }
  if (given != 1) {
    section.refuse("key",
                   fmt::format("the sweep of '{}' has {} of values, linspace and logspace",
                               key.path, given == 0 ? "none" : "more than one"),
                   "give one, e.g. linspace = { from = 0.1, to = 1.0, count = 5 }");
  }
  return values;
}

std::vector<SweepRange> read_sweep_ranges(TomlSection& section) {
  std::vector<SweepRange> ranges;
  for (TomlSection& one : section.tables("keys")) {
    SweepRange range;
    range.key.path = one.required_text("key");
    range.key.unit = one.text("unit").value_or("");
    range.from = one.number("from").value_or(0.0);
    range.to = one.number("to").value_or(0.0);
    range.log = one.flag("log").value_or(false);
    if (range.from == range.to) {
      one.refuse("to",
                 fmt::format("the range of '{}' is empty: it goes from {} to {}", range.key.path,
                             range.from, range.to),
                 "give two different ends");
    }
    if (range.log && !(range.from > 0.0 && range.to > 0.0)) {
      one.refuse("log",
                 fmt::format("the range of '{}' holds {} or {}, which has no logarithm",
                             range.key.path, range.from, range.to),
                 "give two positive ends, or leave log out");
    }
    one.refuse_unknown_keys();
    ranges.push_back(std::move(range));
  }
  if (ranges.empty()) {
    section.refuse("keys", fmt::format("'{}' names no key", section.name_of("keys")),
                   "write keys = [{ key = \"bench.angle_noise\", from = 0.1, to = 1.0, unit = "
                   "\"%\" }]");
  }
  return ranges;
}

}  // namespace flexspline::studies
