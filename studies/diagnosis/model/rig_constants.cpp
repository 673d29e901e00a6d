#include "diagnosis/model/rig_constants.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "diagnosis/frame/baseline.hpp"
#include "flexspline/core/effect.hpp"
#include "flexspline/core/rig.hpp"

namespace flexspline::studies {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

void put_dry_friction(const Frame& frame, const VectorXd& heights, DriveSpec& drive) {
  const auto widths = dry_widths(frame.speed_range);
  Index largest = 0;
  if (!(heights.maxCoeff(&largest) > 0.0)) return;
  drive.motor_coulomb = heights[largest];
  drive.coulomb_width = widths[static_cast<std::size_t>(largest)];
  for (Index k = 0; k < heights.size(); ++k) {
    if (k == largest || !(heights[k] > 0.0)) continue;
    drive.torsion.effects.push_back(
        {"coulomb_viscous_friction",
         {{"coulomb", heights[k]},
          {"viscous", 0.0},
          {"smoothing", widths[static_cast<std::size_t>(k)]}},
         "part of the dry friction, which rises over several widths of speed"});
  }
}

// N K c_a = N^2 J1 + J2 with a point mass as J2 as far as it goes.
void put_load(const Frame& frame, double weight, double inertia, DriveSpec& drive) {
  const bool known = frame.load_mass > 0.0 && frame.arm_length > 0.0;
  drive.arm_length = known ? frame.arm_length : 1.0;
  drive.load_mass = frame.ratio * weight * (known ? frame.load_mass : 1.0);
  const double all = frame.ratio * inertia;
  drive.load_inertia = std::min(all, drive.load_mass * drive.arm_length * drive.arm_length);
  drive.motor_inertia = (all - drive.load_inertia) / (frame.ratio * frame.ratio);
}

// What a servo's motor is fed with becomes a torque; kt and R of a unit winding where it is a
// voltage, whose back-EMF the viscous friction holds.
void put_feed(const Frame& frame, double torque_of_recorded, DriveSpec& drive) {
  if (frame.drives == Quantity::motor_torque) {
    if (torque_of_recorded == 1.0) return;
    drive.torsion.effects.push_back(
        {"torque_constant_error", {{"error", torque_of_recorded - 1.0}}, "from the known weight"});
    return;
  }
  drive.torque_constant = torque_of_recorded;
  if (frame.drives == Quantity::duty_cycle) drive.resistance = 1.0;
}

/// 1 where no weight is known, or one that the recordings do not bear out.
double torque_of_recorded(const Frame& frame, double weight) {
  if (!(frame.load_mass > 0.0 && frame.arm_length > 0.0 && weight > 0.0)) return 1.0;
  const double nm = 1.0 / (frame.ratio * weight);
  return frame.drives == Quantity::motor_torque && std::abs(nm - 1.0) > 0.5 ? 1.0 : nm;
}

double norm_of(const Frame& frame, const ActiveCause& cause, Equation equation,
               const Reference& reference, std::size_t k) {
  return cause.form->columns(equation, frame, reference, cause.shape)[k].matrix().norm();
}

Frame in_true_torque(Frame frame, const TorqueGains& gains) {
  for (auto* torque : {&frame.motor_torque, &frame.smooth_motor_torque, &frame.motor_torque_rate}) {
    *torque *= gains.motor;
  }
  for (auto* torque :
       {&frame.torque, &frame.smooth_torque, &frame.told_torque, &frame.torque_rate}) {
    *torque *= gains.sensor;
  }
  return frame;
}

Reference in_true_torque(Reference reference, const TorqueGains& gains) {
  for (auto* law : {&reference.elastic, &reference.dissipative, &reference.friction}) {
    *law *= gains.sensor;
  }
  return reference;
}

}  // namespace

RigConstants rig_constants(const Frame& frame, const DriveModel& model, TorqueGains gains) {
  RigConstants constants{{}, gains};
  DriveSpec& drive = constants.drive;
  drive.gear_ratio = frame.ratio;
  drive.motor_inertia = frame.motor_inertia;
  drive.load_inertia = frame.load_inertia;
  if (frame.has(Equation::load)) {
    drive.load_viscous = gains.sensor * model.own[index_of(Equation::load)][0];
  } else if (frame.torque_by_inertia && frame.has(Equation::torsion)) {
    const VectorXd& laws = model.own[index_of(Equation::torsion)];
    drive.load_viscous = laws[laws.size() - 1];
  }
  if (!frame.has(Equation::motor)) return constants;
  VectorXd own = model.own[index_of(Equation::motor)];
  const Index dry = static_cast<Index>(dry_widths(frame.speed_range).size());
  if (frame.rig == Rig::servo) {
    constants.gains.motor = torque_of_recorded(frame, own[1 + dry]);
  }
  own *= constants.gains.motor;
  if (frame.rig == Rig::servo) {
    put_load(frame, own[1 + dry], own[2 + dry], drive);
    put_feed(frame, constants.gains.motor, drive);
    constants.gains.sensor = drive.load_mass / (frame.load_mass > 0.0 ? frame.load_mass : 1.0);
  }
  drive.motor_viscous = own[0];
  put_dry_friction(frame, own.segment(1, dry), drive);
  return constants;
}

void mark_origin(const Frame& frame, RigModel& model) {
  auto& origin = model.origin;
  if (frame.rig != Rig::specimen) origin["gear_ratio"] = Origin::given;
  const std::map<std::string_view, double> stated = {{"motor_inertia", frame.motor_inertia},
                                                     {"load_inertia", frame.load_inertia},
                                                     {"load_mass", frame.load_mass},
                                                     {"arm_length", frame.arm_length}};
  for (const DriveConstant& one : rig_row(frame.rig).constants) {
    const double value = model.drive.*one.member;
    const bool of_motor = one.name == "motor_viscous" || one.name == "motor_coulomb";
    if (of_motor && !frame.has(Equation::motor)) {
      origin.emplace(one.name, Origin::not_identifiable);
      continue;
    }
    if (value == 0.0 || (one.name == "coulomb_width" && model.drive.motor_coulomb == 0.0)) continue;
    const auto found = stated.find(one.name);
    const bool given = found != stated.end() && found->second == value;
    origin.emplace(one.name, given ? Origin::given : Origin::fitted);
  }
  if (!frame.has(Equation::torsion)) return;
  origin["f"] = origin["g_inverse"] = Origin::fitted;
  origin["h"] = model.drive.torsion.h.coefficients.empty() ? Origin::assumed : Origin::fitted;
}

void take_gain(const EffectSpec& effect, TorqueGains& gains) {
  if (effect.effect == "torque_constant_error")
    gains.motor *= 1.0 + effect.parameters.front().second;
  if (effect.effect == "torque_sensor_gain") gains.sensor /= 1.0 + effect.parameters.front().second;
}

bool of_torque_sensor(const Counterpart& counterpart) {
  return std::ranges::any_of(counterpart.effects, [](const EffectSpec& effect) {
    const auto row = find_effect(effect.effect);
    return row && (*row)->site == Site::torque_signal;
  });
}

VectorXd catalogued_coefficients(const Frame& frame, const DriveModel& model, std::size_t cause,
                                 const Reference& reference) {
  const auto counterpart_of = [&](std::size_t i) {
    const ActiveCause& one = model.causes[i];
    if (one.form->counterpart == nullptr) return Counterpart{};
    return one.form->counterpart(
        {frame, one.shape, model.coefficients[i], {}, reference.torsion_sign});
  };
  const ActiveCause& one = model.causes[cause];
  const VectorXd& fitted = model.coefficients[cause];
  const Counterpart own = counterpart_of(cause);
  if (one.form->rescales && !own.effects.empty())
    return VectorXd::Constant(1, own.effects.front().parameters.front().second);
  if (one.form->rescales || of_torque_sensor(own)) return fitted;
  RigConstants constants;
  for (std::size_t i = 0; i < model.causes.size(); ++i) {
    if (!model.causes[i].form->rescales) continue;
    for (const EffectSpec& effect : counterpart_of(i).effects) take_gain(effect, constants.gains);
  }
  return constants.in_torque(frame, one, first_equation(frame, *one.form), fitted, reference);
}

// A column that grows with the torque that was read needs no factor, one that does not needs it
// whole.
VectorXd RigConstants::in_torque(const Frame& frame, const ActiveCause& cause, Equation equation,
                                 const VectorXd& coefficients, const Reference& reference) const {
  const bool as_read = gains.motor == 1.0 && gains.sensor == 1.0;
  if (as_read || cause.form->columns == nullptr) return coefficients;
  const Frame true_frame = in_true_torque(frame, gains);
  const Reference true_reference = in_true_torque(reference, gains);
  const double factor = equation == Equation::motor ? gains.motor : gains.sensor;
  VectorXd in_nm = coefficients;
  for (Index k = 0; k < in_nm.size(); ++k) {
    const auto column = static_cast<std::size_t>(k);
    const double now = norm_of(true_frame, cause, equation, true_reference, column);
    if (!(now > 0.0)) continue;
    in_nm[k] *= factor * norm_of(frame, cause, equation, reference, column) / now;
  }
  return in_nm;
}

}  // namespace flexspline::studies
