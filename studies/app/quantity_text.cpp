#include "quantity_text.hpp"

#include <charconv>

#include <fmt/format.h>

namespace flexspline::app {

Result<double> parse_quantity(const std::string& option, const std::string& given,
                              Dimension dimension) {
  double number = 0.0;
  const auto [end, error] = std::from_chars(given.data(), given.data() + given.size(), number);
  std::string symbol(end, given.data() + given.size());
  symbol.erase(0, symbol.find_first_not_of(' '));
  const auto unit = find_unit(symbol);
  if (error != std::errc{} || !unit || unit->dimension != dimension) {
    return failure(ErrorCode::usage,
                   fmt::format("--{} '{}' is not a number with a unit of {}", option, given,
                               name_of(dimension)),
                   fmt::format("units: {}", symbols_of(dimension)));
  }
  return to_si(*unit, number);
}

}  // namespace flexspline::app
