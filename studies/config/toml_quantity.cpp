#include <cmath>

#include <fmt/format.h>

#include "config/toml_section.hpp"

namespace flexspline::studies {

std::optional<double> TomlSection::number(std::string_view key) {
  const toml::node* found = node(key);
  if (found == nullptr) {
    refuse(key, fmt::format("'{}' is missing", name_of(key)), "write { value = …, unit = \"…\" }");
    return std::nullopt;
  }
  const std::optional<double> value = found->value<double>();
  if (!found->is_number() || !value || !std::isfinite(*value)) {
    refuse_at(*found, fmt::format("'{}' is not a finite number", name_of(key)));
    return std::nullopt;
  }
  return value;
}

std::optional<std::vector<double>> TomlSection::numbers(const toml::node& list,
                                                        const std::string& what) {
  const toml::array* array = list.as_array();
  if (array == nullptr) {
    refuse_at(list, fmt::format("'{}' is not a list of numbers", what), "write [0.1, 0.2]");
    return std::nullopt;
  }
  std::vector<double> values;
  for (const toml::node& entry : *array) {
    const std::optional<double> value = entry.value<double>();
    if (!entry.is_number() || !value || !std::isfinite(*value)) {
      refuse_at(entry, fmt::format("an entry of '{}' is not a finite number", what));
      return std::nullopt;
    }
    values.push_back(*value);
  }
  return values;
}

std::optional<Unit> TomlSection::unit(Dimension dimension) {
  const std::optional<std::string> symbol = text("unit");
  if (!symbol) {
    refuse("unit", fmt::format("'{}' is missing", name_of("unit")),
           fmt::format("give a unit of {}: {}", flexspline::name_of(dimension),
                       symbols_of(dimension)));
    return std::nullopt;
  }
  const std::optional<Unit> found = find_unit(*symbol);
  if (found && found->dimension == dimension) return found;
  refuse("unit",
         found ? fmt::format("'{}' = \"{}\" is a unit of {}, not of {}", name_of("unit"), *symbol,
                             flexspline::name_of(found->dimension), flexspline::name_of(dimension))
               : fmt::format("'{}' = \"{}\" is not a unit", name_of("unit"), *symbol),
         fmt::format("use one of: {}", symbols_of(dimension)));
  return std::nullopt;
}

std::optional<double> TomlSection::quantity(std::string_view key, Dimension dimension, double low) {
  const toml::node* found = node(key);
  if (found == nullptr) return std::nullopt;
  if (!found->is_table()) {
    refuse_at(*found, fmt::format("'{}' has no unit", name_of(key)),
              fmt::format("write {} = {{ value = …, unit = \"…\" }}", key));
    return std::nullopt;
  }
  TomlSection inner = *table(key);
  const std::optional<double> value = inner.number("value");
  const std::optional<Unit> given = inner.unit(dimension);
  inner.refuse_unknown_keys();
  if (!value || !given) return std::nullopt;
  const double si = to_si(*given, *value);
  if (si >= low) return si;
  refuse_at(*found, fmt::format("'{}' = {} {} is too small", name_of(key), *value, given->symbol),
            fmt::format("give at least {} {}", from_si(*given, low), given->symbol));
  return std::nullopt;
}

std::vector<double> TomlSection::quantities(std::string_view key, Dimension dimension) {
  const toml::node* found = node(key);
  if (found == nullptr) return {};
  if (!found->is_table()) {
    refuse_at(*found, fmt::format("'{}' has no unit", name_of(key)),
              fmt::format("write {} = {{ values = [ … ], unit = \"…\" }}", key));
    return {};
  }
  TomlSection inner = *table(key);
  const toml::node* list = inner.node("values");
  const std::optional<Unit> given = inner.unit(dimension);
  inner.refuse_unknown_keys();
  if (list == nullptr) {
    inner.refuse("values", fmt::format("'{}' is missing", inner.name_of("values")),
                 "write values = [ … ]");
    return {};
  }
  std::optional<std::vector<double>> values = inner.numbers(*list, inner.name_of("values"));
  if (!values || !given) return {};
  if (values->empty()) {
    refuse_at(*list, fmt::format("'{}' is empty", inner.name_of("values")), "give at least one");
  }
  for (double& value : *values) {
    if (!(value > 0.0)) {
      refuse_at(*list, fmt::format("'{}' holds {}", inner.name_of("values"), value),
                "every entry has to be positive");
    }
    value = to_si(*given, value);
  }
  return *values;
}

}  // namespace flexspline::studies
