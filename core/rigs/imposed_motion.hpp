#pragma once

#include <vector>

#include "rigs/enter_transmission.hpp"

namespace flexspline {

/// The torque of a specimen: eq. (4) and all effects that add to it, which see that of eq. (4).
struct SpecimenTorque {
  template <class S>
  S operator()(const DriveAt<S>& at, Instant<S>& x) const {
    x.transmitted_torque = at.torsion_law(x);
    const S effects =
        at.sum(Site::transmission, x) + at.sum(Site::motor, x) + at.sum(Site::load, x);
    return x.transmitted_torque + effects;
  }
};

/// A specimen that is moved. States: the work done on it (, torsion of the law). Kinematics see the
/// whole torque, as when it is driven by force.
struct ImposedMotion {
  DriveModel model;
  RigInputs inputs;
  std::vector<RigVariable> variables;

  template <class S>
  Instant<S> rates(double t, std::span<const S> y, std::span<const S> p, std::span<S> ydot) const {
    const std::size_t own = variables.size();
    const DriveAt<S> at(model, p, y.subspan(own));
    const Signal& motion = input(inputs, Quantity::torsion);
    Instant<S> x;
    x.time = S(t);
    x.motor_angle = x.load_angle = x.torsion = S(motion.value(t));
    x.motor_speed = x.load_speed = x.torsion_rate = S(rate_of(motion, t));
    x.motor_acceleration = x.load_acceleration = x.torsion_acceleration = bend_of(motion, t);
    const Instant<S> rigid = enter_transmission(at, x, y[own - 1], SpecimenTorque{});
    ydot[0] = x.transmitted_torque * x.motor_speed;
    if (model.torsion_is_state()) ydot[own - 1] = x.torsion_rate;
    at.memory_rates(rigid, x, ydot.subspan(own));
    return x;
  }
};

}  // namespace flexspline
