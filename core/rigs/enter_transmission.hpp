#pragma once

#include <vector>

#include "rigs/implicit_root.hpp"
#include "rigs/rig_parts.hpp"

namespace flexspline {

inline constexpr RigVariable kLawTorsion = {"law_torsion", "rad",
                                            "phi of the law, without what yields in series"};

/// The real parts of an instant that the equations are solved at.
template <class S>
Instant<Complex> real_instant(const Instant<S>& x) {
  Instant<Complex> z;
  const auto take = [&](auto from, auto to) { z.*to = Complex(real_part(x.*from)); };
  using X = Instant<S>;
  using Z = Instant<Complex>;
  take(&X::time, &Z::time);
  take(&X::gear_ratio, &Z::gear_ratio);
  take(&X::motor_angle, &Z::motor_angle);
  take(&X::motor_speed, &Z::motor_speed);
  take(&X::load_angle, &Z::load_angle);
  take(&X::load_speed, &Z::load_speed);
  take(&X::torsion, &Z::torsion);
  take(&X::torsion_rate, &Z::torsion_rate);
  take(&X::motor_torque, &Z::motor_torque);
  take(&X::motor_torque_rate, &Z::motor_torque_rate);
  return z;
}

/// The torque that kinematics of a drive see; it is what a rig gives for a law of torque.
struct TransmittedTorque {
  template <class S>
  S operator()(const DriveAt<S>& at, Instant<S>& x) const {
    return at.transmitted(x);
  }
};

/// What is left of phi_law = phi + e(tau), or of its derivative, when the law's torsion has that
/// rate. Rises with it where nothing grows under load.
template <class S, class Torque>
S left_of_kinematics(const DriveAt<S>& at, const Instant<S>& rigid, const S& torsion, const S& rate,
                     const Torque& torque) {
  Instant<S> x = rigid;
  x.torsion = torsion;
  x.torsion_rate = rate;
  Instant<S> loaded = rigid;
  loaded.transmitted_torque = torque(at, x);
  if (at.model().torsion_is_state()) return torsion - rigid.torsion - at.kinematics(loaded);
  return rate - rigid.torsion_rate - at.kinematics_rate(loaded);
}

/// The rate of the law's torsion at which the torque and the kinematics that follow it agree.
template <class S, class Torque>
S law_rate(const DriveAt<S>& at, const Instant<S>& rigid, const S& torsion, const Torque& torque) {
  const auto parameters = real_parts(at.parameters());
  const auto memory = real_parts(at.memory());
  const DriveAt<Complex> complex_at(at.model(), parameters, memory);
  const Instant<Complex> complex_rigid = real_instant(rigid);
  const Complex complex_torsion(real_part(torsion));
  return implicit_root<S>(
      [&](const Complex& v) {
        return left_of_kinematics(complex_at, complex_rigid, complex_torsion, v, torque);
      },
      [&](const S& v) { return left_of_kinematics(at, rigid, torsion, v, torque); },
      at.model().drive().torsion.g_inverse.scale);
}

/// Enters the law's torsion, its rate and the torque transmitted. law_torsion: the rig's state for
/// it, where it is one. Returns the instant without the kinematics, as their memory and what they
/// return to the shafts see it.
template <class S, class Torque = TransmittedTorque>
Instant<S> enter_transmission(const DriveAt<S>& at, Instant<S>& x, const S& law_torsion,
                              const Torque& torque = {}) {
  Instant<S> rigid = x;
  if (at.model().kinematics_follow_torque()) {
    x.torsion = at.model().torsion_is_state() ? law_torsion : rigid.torsion + at.kinematics(rigid);
    x.torsion_rate = law_rate(at, rigid, x.torsion, torque);
  } else {
    at.add_kinematics(x);
  }
  x.transmitted_torque = torque(at, x);
  rigid.transmitted_torque = x.transmitted_torque;
  return rigid;
}

/// A form's states with what the kinematics of the model need beside them.
inline std::vector<RigVariable> states_with_kinematics(const DriveModel& model,
                                                       const RigForm& form) {
  auto states = form.states;
  if (model.torsion_is_state()) states.push_back(kLawTorsion);
  return states;
}

}  // namespace flexspline
