#include "flexspline/core/drive_spec.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "flexspline/core/effect.hpp"
#include "flexspline/core/error.hpp"

namespace flexspline {
namespace {

void append_law(std::vector<DriveParameter>& list, std::string_view name, const LawSpec& law,
                std::string_view unit) {
  for (std::size_t k = 0; k < law.coefficients.size(); ++k) {
    const bool exponent = law.law == "power_law" && k == 1;
    list.push_back(
        {fmt::format("{}[{}]", name, k), std::string(exponent ? "1" : unit), law.coefficients[k]});
  }
}

void append_effect(std::vector<DriveParameter>& list, const EffectSpec& effect) {
  const auto row = find_effect(effect.effect);
  const std::size_t group = row ? (*row)->parameters.size() : 0;
  for (std::size_t k = 0; k < effect.parameters.size(); ++k) {
    const std::string element = row && (*row)->repeats ? fmt::format("[{}]", k / group) : "";
    const std::string_view unit = group > 0 ? (*row)->parameters[k % group].unit : "";
    list.push_back({fmt::format("{}{}.{}", effect.effect, element, effect.parameters[k].first),
                    std::string(unit), effect.parameters[k].second});
  }
}

constexpr std::array kOrigins = {
    std::pair{Origin::given, std::string_view("given")},
    std::pair{Origin::fitted, std::string_view("fitted")},
    std::pair{Origin::not_identifiable, std::string_view("not identifiable")},
    std::pair{Origin::assumed, std::string_view("assumed")}};

}  // namespace

std::string_view name_of(Origin origin) {
  return std::ranges::find(kOrigins, origin, &decltype(kOrigins)::value_type::first)->second;
}

std::optional<Origin> find_origin(std::string_view name) {
  const auto found = std::ranges::find(kOrigins, name, &decltype(kOrigins)::value_type::second);
  if (found == kOrigins.end()) return std::nullopt;
  return found->first;
}

std::span<const DriveConstant> drive_constants() {
  using D = DriveSpec;
  static const std::vector<DriveConstant> rows = {
      {"motor_inertia", "kg m2", &D::motor_inertia, "J1, motor and wave generator"},
      {"motor_viscous", "Nm s/rad", &D::motor_viscous, "B1, at the motor"},
      {"motor_coulomb", "Nm", &D::motor_coulomb, "height of tau_f, at the motor"},
      {"coulomb_width", "rad/s", &D::coulomb_width, "speed over which tau_f changes its sign"},
      {"load_inertia", "kg m2", &D::load_inertia, "J2, at the output"},
      {"load_viscous", "Nm s/rad", &D::load_viscous, "B2, at the output"},
      {"load_mass", "kg", &D::load_mass, "mass of the pendulum"},
      {"arm_length", "m", &D::arm_length, "length of the pendulum"},
      {"torque_constant", "Nm/A", &D::torque_constant, "kt"},
      {"resistance", "Ohm", &D::resistance, "R of the winding"},
      {"inductance", "H", &D::inductance, "L of the winding"},
      {"back_emf", "V s/rad", &D::back_emf, "ke"},
  };
  return rows;
}

std::vector<DriveConstant> constants_named(std::initializer_list<std::string_view> names) {
  std::vector<DriveConstant> list;
  for (std::string_view name : names) {
    const auto found = std::ranges::find(drive_constants(), name, &DriveConstant::name);
    expects(found != drive_constants().end(), "every constant named has a row");
    list.push_back(*found);
  }
  return list;
}

double reflected_inertia(const DriveSpec& drive) {
  return drive.gear_ratio * drive.gear_ratio * drive.motor_inertia;
}

double reflected_viscous(const DriveSpec& drive) {
  return drive.gear_ratio * drive.gear_ratio * drive.motor_viscous;
}

double reflected_torque(const DriveSpec& drive, double motor_torque, double motor_speed) {
  const double friction = drive.motor_coulomb * std::tanh(motor_speed / drive.coulomb_width);
  return drive.gear_ratio * (motor_torque - friction);
}

std::vector<DriveParameter> parameters_of(const DriveSpec& drive,
                                          std::span<const DriveConstant> constants) {
  std::vector<DriveParameter> list;
  append_law(list, "f", drive.torsion.f, "Nm");
  append_law(list, "g_inverse", drive.torsion.g_inverse, "Nm");
  append_law(list, "h", drive.torsion.h, "1");
  for (const DriveConstant& one : constants) {
    list.push_back({std::string(one.name), std::string(one.unit), drive.*one.member});
  }
  for (const EffectSpec& effect : drive.torsion.effects) append_effect(list, effect);
  return list;
}

DriveSpec with_parameters(DriveSpec drive, std::span<const DriveConstant> constants,
                          std::span<const double> values) {
  std::size_t k = 0;
  const auto next = [&] {
    expects(k < values.size(), "a parameter vector is as long as the drive's own");
    return values[k++];
  };
  for (LawSpec* law : {&drive.torsion.f, &drive.torsion.g_inverse, &drive.torsion.h}) {
    for (double& c : law->coefficients) c = next();
  }
  for (const DriveConstant& one : constants) drive.*one.member = next();
  for (EffectSpec& effect : drive.torsion.effects) {
    for (auto& parameter : effect.parameters) parameter.second = next();
  }
  return drive;
}

}  // namespace flexspline
