#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>
#include <Eigen/Dense>

#include "flexspline/core/rig.hpp"
#include "flexspline/core/rig_residuals.hpp"
#include "flexspline/core/simulate_rig.hpp"
#include "flexspline/estimators/rig_fit.hpp"
#include "rig/shaft_equation.hpp"

namespace flexspline::estimators {
namespace {

constexpr std::size_t kEnd = 4;  // samples: a smoothing spline's derivatives are loose at its ends

bool counts(const Recording& recording, std::size_t i) {
  if (i < kEnd || i + kEnd >= recording.time.size()) return false;
  for (Quantity mark : {Quantity::valid, Quantity::drive_enabled}) {
    const auto* marks = recording.find(mark);
    if (marks != nullptr && (*marks)[i] < 0.5) return false;
  }
  return true;
}

void add_rows(const Recording& recording, const std::vector<double>& torque,
              const std::vector<double>& speed, const std::vector<double>& acceleration,
              ShaftEquation& equation) {
  for (std::size_t i = 0; i < torque.size(); ++i) {
    if (!counts(recording, i)) continue;
    equation.torque.push_back(torque[i]);
    equation.speed.push_back(speed[i]);
    equation.acceleration.push_back(acceleration[i]);
  }
}

/// Both shafts' equations over the training recordings, or why there is none.
struct Shafts {
  ShaftEquation motor{
      .dry = true, .names = {"motor_inertia", "motor_viscous", "motor_coulomb", "coulomb_width"}};
  ShaftEquation load{.dry = false, .names = {"load_inertia", "load_viscous", "", ""}};

  Result<void> add(const RigModel& model, const Recording& recording) {
    const auto channels = drive_channels(model.rig, model.drive, recording);
    if (!channels) return tl::unexpected(channels.error());
    const auto left = residuals(model.rig, model.drive, *channels);
    if (!left) return tl::unexpected(in_context(left.error(), recording.id));
    add_rows(recording, left->motor.value, channels->motor_speed, channels->motor_acceleration,
             motor);
    add_rows(recording, left->load.value, channels->load_speed, channels->load_acceleration, load);
    if (motor.absent.empty()) motor.absent = left->motor.absent;
    if (load.absent.empty()) load.absent = left->load.absent;
    return {};
  }
};

/// Enters what an equation tells; where it cannot be formed, that its constants are unknown.
void enter(const ShaftEquation& equation, bool inertia_stated, RigFit& fit) {
  const auto constants = rig_row(fit.model.rig).constants;
  for (const std::string& name : equation.names) {
    const auto found = std::ranges::find(constants, name, &DriveConstant::name);
    if (found == constants.end()) continue;
    if (inertia_stated && name == equation.names.front()) continue;
    fit.model.origin[name] = Origin::not_identifiable;
  }
  if (equation.torque.empty()) return;
  for (FittedConstant& one : fitted(equation, inertia_stated)) {
    const auto found = std::ranges::find(constants, one.estimate.name, &DriveConstant::name);
    if (found == constants.end()) continue;
    fit.model.drive.*found->member = one.estimate.value;
    fit.model.origin[one.estimate.name] =
        one.identifiable ? Origin::fitted : Origin::not_identifiable;
    one.estimate.unit = found->unit;
    fit.parameters.push_back(std::move(one.estimate));
  }
}

void say_what_lacks(const RigFit& fit, const ShaftEquation& equation,
                    std::vector<std::string>& notes) {
  std::string names;
  for (const std::string& name : equation.names) {
    const auto found = fit.model.origin.find(name);
    if (found == fit.model.origin.end() || found->second != Origin::not_identifiable) continue;
    names += (names.empty() ? "" : ", ") + name;
  }
  if (names.empty()) return;
  notes.push_back(fmt::format("{}: not identifiable from these recordings ({})", names,
                              equation.torque.empty()
                                  ? equation.absent
                                  : "their 95 % intervals hold zero, or all values do as well"));
}

void mark_stated(const RecordingSet& set, RigFit& fit) {
  auto& origin = fit.model.origin;
  const DriveSpec& drive = fit.model.drive;
  origin["gear_ratio"] = set.constants.contains("gear_ratio") ? Origin::given : Origin::assumed;
  for (const DriveConstant& one : rig_row(fit.model.rig).constants) {
    if (one.name != "coulomb_width" && drive.*one.member != 0.0) {
      origin.emplace(one.name, Origin::given);
    }
  }
}

}  // namespace

Result<RigFit> complete_rig(const RecordingSet& set, const ModelSpec& torsion) {
  RigFit fit{{set.rig, stated_drive(set)}, {}, {}};
  fit.model.drive.torsion = torsion;
  if (set.rig == Rig::specimen) return fit;
  mark_stated(set, fit);
  Shafts shafts;
  for (const Recording& one : set.recordings) {
    if (one.split == Split::holdout) continue;
    if (auto added = shafts.add(fit.model, one); !added) return tl::unexpected(added.error());
  }
  enter(shafts.motor, fit.model.origin.contains("motor_inertia"), fit);
  if (set.rig == Rig::free) enter(shafts.load, fit.model.origin.contains("load_inertia"), fit);
  for (const ShaftEquation* one : {&shafts.motor, &shafts.load}) {
    say_what_lacks(fit, *one, fit.notes);
  }
  return fit;
}

}  // namespace flexspline::estimators
