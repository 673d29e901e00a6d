#include "flexspline/core/units.hpp"

#include <algorithm>
#include <array>
#include <numbers>

namespace flexspline {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDegree = kPi / 180.0;
constexpr double kInch = 0.0254;
constexpr double kPound = 4.4482216152605;  // lbf in N, exact by definition

using enum Dimension;

constexpr Unit kUnits[] = {
    {"1", dimensionless, 1.0, 0.0},
    {"%", dimensionless, 0.01, 0.0},
    {"s", Dimension::time, 1.0, 0.0},
    {"ms", Dimension::time, 1e-3, 0.0},
    {"us", Dimension::time, 1e-6, 0.0},
    {"min", Dimension::time, 60.0, 0.0},
    {"h", Dimension::time, 3600.0, 0.0},
    {"Hz", frequency, 1.0, 0.0},
    {"mHz", frequency, 1e-3, 0.0},
    {"kHz", frequency, 1e3, 0.0},
    {"rad", angle, 1.0, 0.0},
    {"mrad", angle, 1e-3, 0.0},
    {"urad", angle, 1e-6, 0.0},
    {"deg", angle, kDegree, 0.0},
    {"arcmin", angle, kDegree / 60.0, 0.0},
    {"arcsec", angle, kDegree / 3600.0, 0.0},
    {"rev", angle, 2.0 * kPi, 0.0},
    {"m", length, 1.0, 0.0},
    {"cm", length, 1e-2, 0.0},
    {"mm", length, 1e-3, 0.0},
    {"um", length, 1e-6, 0.0},
    {"in", length, kInch, 0.0},
    {"rad/s", angular_velocity, 1.0, 0.0},
    {"mrad/s", angular_velocity, 1e-3, 0.0},
    {"urad/s", angular_velocity, 1e-6, 0.0},
    {"deg/s", angular_velocity, kDegree, 0.0},
    {"arcmin/s", angular_velocity, kDegree / 60.0, 0.0},
    {"arcsec/s", angular_velocity, kDegree / 3600.0, 0.0},
    {"rev/s", angular_velocity, 2.0 * kPi, 0.0},
    {"rpm", angular_velocity, 2.0 * kPi / 60.0, 0.0},
    {"m/s", velocity, 1.0, 0.0},
    {"cm/s", velocity, 1e-2, 0.0},
    {"mm/s", velocity, 1e-3, 0.0},
    {"um/s", velocity, 1e-6, 0.0},
    {"in/s", velocity, kInch, 0.0},
    {"Nm", torque, 1.0, 0.0},
    {"mNm", torque, 1e-3, 0.0},
    {"kNm", torque, 1e3, 0.0},
    {"Ncm", torque, 1e-2, 0.0},
    {"Nmm", torque, 1e-3, 0.0},
    {"lbf in", torque, kPound* kInch, 0.0},
    {"lbf ft", torque, kPound * 12.0 * kInch, 0.0},
    {"N", force, 1.0, 0.0},
    {"mN", force, 1e-3, 0.0},
    {"kN", force, 1e3, 0.0},
    {"lbf", force, kPound, 0.0},
    {"A", current, 1.0, 0.0},
    {"mA", current, 1e-3, 0.0},
    {"V", voltage, 1.0, 0.0},
    {"mV", voltage, 1e-3, 0.0},
    {"K", temperature, 1.0, 0.0},
    {"degC", temperature, 1.0, 273.15},
    {"degF", temperature, 5.0 / 9.0, 459.67 * 5.0 / 9.0},
};

/// Other ways in which benches write a unit, none of which can mean another one.
constexpr std::pair<std::string_view, std::string_view> kOtherSpellings[] = {
    {"sec", "s"},         {"µs", "us"},  // micro sign; below, the Greek letter
    {"μs", "us"},         {"°", "deg"},         {"µrad", "urad"},     {"μrad", "urad"},
    {"µm", "um"},         {"μm", "um"},         {"°/s", "deg/s"},     {"1/min", "rpm"},
    {"r/min", "rpm"},     {"rev/min", "rpm"},   {"°C", "degC"},       {"°F", "degF"},
    {"N.m", "Nm"},        {"N·m", "Nm"},        {"N⋅m", "Nm"},        {"N*m", "Nm"},
    {"N m", "Nm"},        {"N-m", "Nm"},        {"mN.m", "mNm"},      {"mN·m", "mNm"},
    {"mN⋅m", "mNm"},      {"mN*m", "mNm"},      {"mN m", "mNm"},      {"kN.m", "kNm"},
    {"kN·m", "kNm"},      {"kN*m", "kNm"},      {"N.cm", "Ncm"},      {"N·cm", "Ncm"},
    {"N.mm", "Nmm"},      {"N·mm", "Nmm"},      {"in-lb", "lbf in"},  {"in lb", "lbf in"},
    {"in-lbf", "lbf in"}, {"in lbf", "lbf in"}, {"lb-in", "lbf in"},  {"lb in", "lbf in"},
    {"lbf-in", "lbf in"}, {"lbf·in", "lbf in"}, {"ft-lb", "lbf ft"},  {"ft lb", "lbf ft"},
    {"ft-lbf", "lbf ft"}, {"lb-ft", "lbf ft"},  {"lbf-ft", "lbf ft"}, {"lbf·ft", "lbf ft"},
};

}  // namespace

std::span<const Unit> units() { return kUnits; }

std::optional<Unit> find_unit(std::string_view symbol) {
  using Spelling = std::pair<std::string_view, std::string_view>;
  const auto* spelling = std::ranges::find(kOtherSpellings, symbol, &Spelling::first);
  if (spelling != std::end(kOtherSpellings)) symbol = spelling->second;
  const auto* found = std::ranges::find(kUnits, symbol, &Unit::symbol);
  if (found == std::end(kUnits)) return std::nullopt;
  return *found;
}

std::string_view name_of(Dimension dimension) {
  constexpr std::array<std::string_view, 12> names = {
      "dimensionless", "time",   "frequency", "angle",   "length",  "angular velocity",
      "velocity",      "torque", "force",     "current", "voltage", "temperature"};
  return names.at(static_cast<std::size_t>(dimension));
}

std::string symbols_of(Dimension dimension) {
  std::string symbols;
  for (const Unit& unit : kUnits) {
    if (unit.dimension != dimension) continue;
    if (!symbols.empty()) symbols += ", ";
    symbols += unit.symbol;
  }
  return symbols;
}

}  // namespace flexspline
