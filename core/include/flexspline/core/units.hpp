#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace flexspline {

/// Physical dimension of a channel or a setting.
enum class Dimension {
  dimensionless,
  time,
  frequency,
  angle,
  length,
  angular_velocity,
  velocity,
  torque,
  force,
  current,
  voltage,
  temperature,
};

/// One unit: value_si = factor * value + offset.
struct Unit {
  std::string_view symbol;
  Dimension dimension;
  double factor;
  double offset;
};

/// Every unit that files may use, e.g. deg, rad, arcmin, rev, rad/s, deg/s, rpm, Nm, mNm, kNm, s,
/// ms.
std::span<const Unit> units();

/// The unit with this symbol, or with another spelling that can mean nothing else ("N.m", "°",
/// "in-lb"); its symbol is then that of units().
std::optional<Unit> find_unit(std::string_view symbol);

/// Name of a dimension for messages, e.g. "angle".
std::string_view name_of(Dimension dimension);

/// Symbols of all units of a dimension, comma separated, for messages.
std::string symbols_of(Dimension dimension);

inline double to_si(const Unit& unit, double value) { return unit.factor * value + unit.offset; }
inline double from_si(const Unit& unit, double value) {
  return (value - unit.offset) / unit.factor;
}

}  // namespace flexspline
