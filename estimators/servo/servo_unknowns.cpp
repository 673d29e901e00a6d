#include "servo/servo_unknowns.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "flexspline/core/nearest_name.hpp"

namespace flexspline::estimators {
namespace {

constexpr double kRodShare = 0.1;   // of the load's mass, at the start
constexpr double kMostZero = 0.5;   // rad
constexpr double kZeroSize = 0.02;  // rad

std::size_t place_of(const std::vector<DriveParameter>& all, std::string_view name) {
  const auto found = std::ranges::find(all, name, &DriveParameter::name);
  expects(found != all.end(), "a servo's rig has this parameter");
  return static_cast<std::size_t>(found - all.begin());
}

void add_constant(ServoUnknowns& unknowns, const std::vector<DriveParameter>& all,
                  std::initializer_list<std::string_view> names, double start) {
  std::vector<RigTarget> targets;
  for (const std::string_view name : names) targets.push_back({place_of(all, name)});
  unknowns.parameters.push_back({.name = std::string(*names.begin()),
                                 .start = start,
                                 .lower = 1e-3 * start,
                                 .upper = 1e3 * start,
                                 .scale = start,
                                 .unit = all[targets.front().at].unit});
  unknowns.targets.push_back(std::move(targets));
}

/// A uniform rod from the axis to the load: half its mass pulls, a third of it is inert there. All
/// torques grow with the weight, so that resistance and motor inertia start in its proportion.
void add_rod(ServoUnknowns& unknowns, const std::vector<DriveParameter>& all,
             const DriveSpec& drive, std::size_t moment) {
  const double square = drive.arm_length * drive.arm_length;
  const double load = drive.load_inertia / square;
  const double rod = kRodShare * load;
  unknowns.targets.push_back({{moment, all[moment].value, 0.5 * drive.gravity * drive.arm_length},
                              {place_of(all, "load_inertia"), drive.load_inertia, square / 3.0}});
  const double heavier = 1.0 + 0.5 * kRodShare;
  for (OdeParameter& one : unknowns.parameters) {
    if (one.name == "resistance") one.start /= heavier;
    if (one.name == "motor_inertia") {
      const double total = heavier * (one.start + drive.load_inertia);
      one.start = std::max(one.start, total - drive.load_inertia - rod * square / 3.0);
    }
  }
  unknowns.parameters.push_back({.name = "arm_mass",
                                 .start = rod,
                                 .lower = 0.0,
                                 .upper = 10.0 * load,
                                 .scale = rod,
                                 .unit = "kg"});
}

void add_zero(ServoUnknowns& unknowns, std::size_t phase) {
  unknowns.parameters.push_back({.name = "load_angle_zero",
                                 .start = 0.0,
                                 .lower = -kMostZero,
                                 .upper = kMostZero,
                                 .scale = kZeroSize,
                                 .unit = "rad"});
  unknowns.targets.push_back({{phase, 0.0, -1.0}});
}

void add_effects(ServoUnknowns& unknowns, const std::vector<GivenParameter>& given,
                 std::size_t laws, std::size_t first) {
  for (std::size_t k = laws; k < given.size(); ++k) {
    const GivenParameter& one = given[k];
    if (one.held) continue;
    const double scale = one.start != 0.0 ? std::abs(one.start) : 1.0;
    unknowns.parameters.push_back({one.name, one.start, one.lower, one.upper, scale, one.unit});
    unknowns.targets.push_back({{first + k - laws}});
  }
}

}  // namespace

DriveSpec with_weight_as_effect(DriveSpec drive) {
  const double moment = drive.load_mass * drive.gravity * drive.arm_length;
  drive.torsion.effects.push_back({"gravity_load", {{"moment", moment}, {"phase", 0.0}}});
  drive.load_mass = 0.0;
  return drive;
}

ServoUnknowns servo_unknowns(const DriveSpec& drive, const std::vector<DriveParameter>& all,
                             const std::vector<GivenParameter>& given,
                             const ServoSettings& settings) {
  ServoUnknowns unknowns;
  add_constant(unknowns, all, {"torque_constant", "back_emf"}, drive.torque_constant);
  add_constant(unknowns, all, {"resistance"}, drive.resistance);
  add_constant(unknowns, all, {"motor_inertia"}, drive.motor_inertia);
  // The weight's moment and phase are the rig's last parameters, behind those of the model.
  const std::size_t moment = all.size() - 2;
  if (settings.arm == ServoArm::rod) add_rod(unknowns, all, drive, moment);
  if (settings.zero == ServoZero::fitted) add_zero(unknowns, moment + 1);
  std::size_t laws = 0;
  for (const LawSpec* law : {&drive.torsion.f, &drive.torsion.g_inverse, &drive.torsion.h})
    laws += law->coefficients.size();
  add_effects(unknowns, given, laws, moment - (given.size() - laws));
  return unknowns;
}

Result<void> start_at(const std::map<std::string, double>& starts, ServoUnknowns& unknowns) {
  std::vector<std::string_view> names;
  for (const OdeParameter& one : unknowns.parameters) names.emplace_back(one.name);
  for (const auto& [name, value] : starts) {
    const auto found = std::ranges::find(unknowns.parameters, name, &OdeParameter::name);
    if (found == unknowns.parameters.end()) {
      return failure(ErrorCode::bad_data,
                     fmt::format("an initial guess is given for {}, which is no unknown of this fit", name),
                     suggestion(name, names));
    }
    if (!(value >= found->lower && value <= found->upper)) {
      return failure(ErrorCode::bad_data,
                     fmt::format("{} starts at {:.6g} {}", name, value, found->unit),
                     fmt::format("it lies in [{:.6g}, {:.6g}]", found->lower, found->upper));
    }
    found->start = value;
  }
  return {};
}

}  // namespace flexspline::estimators
