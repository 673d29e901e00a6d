#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "flexspline/core/effect_path.hpp"
#include "rigs/drive_model.hpp"

namespace flexspline {

template <class S>
const EffectFunctions<S>& functions_at(const EffectRow& row) {
  if constexpr (std::is_same_v<S, double>) {
    return row.real;
  } else if constexpr (std::is_same_v<S, Dual>) {
    return row.dual;
  } else {
    return row.complex;
  }
}

/// A drive model at parameters and memory of one scalar.
template <class S>
class DriveAt {
 public:
  DriveAt(const DriveModel& model, std::span<const S> p, std::span<const S> memory)
      : model_(model), p_(p), memory_(memory) {}

  const DriveModel& model() const { return model_; }
  std::span<const S> parameters() const { return p_; }
  std::span<const S> memory() const { return memory_; }

  S constant(double DriveSpec::*member) const {
    const auto constants = model_.constants();
    for (std::size_t k = 0; k < constants.size(); ++k) {
      if (constants[k].member == member) return p_[model_.first_constant() + k];
    }
    return S(model_.drive().*member);
  }

  S f(const S& torsion) const { return law(0, torsion); }
  S g_inverse(const S& v) const { return law(1, v); }
  S h(const S& torsion) const { return law(2, torsion); }

  /// f(phi) + g^-1(phi'/h(phi)), eq. (4).
  S torsion_law(const Instant<S>& x) const {
    return f(x.torsion) + g_inverse(x.torsion_rate / h(x.torsion));
  }

  /// What the effects at a site add.
  S sum(Site site, const Instant<S>& x) const {
    S total(0.0);
    for (const EffectUse& use : model_.effects()) {
      if (use.site == site) total += term(use, x);
    }
    return total;
  }

  /// What crosses the transmission, all effects there included, which see the torsion law's torque.
  S transmitted(Instant<S>& x) const {
    x.transmitted_torque = torsion_law(x);
    return x.transmitted_torque + sum(Site::transmission, x);
  }

  /// tau_f + B1 omega + effects at the motor.
  S motor_losses(const Instant<S>& x) const {
    const S coulomb = constant(&DriveSpec::motor_coulomb) *
                      smooth_sign(x.motor_speed, constant(&DriveSpec::coulomb_width));
    const S viscous = constant(&DriveSpec::motor_viscous) * x.motor_speed;
    return coulomb + viscous + sum(Site::motor, x);
  }

  /// B2 omega + m g l sin(theta) + effects at the load.
  S load_torque(const Instant<S>& x) const {
    using std::sin;
    const S weight = constant(&DriveSpec::load_mass) * constant(&DriveSpec::arm_length);
    const S gravity = weight * (model_.drive().gravity * sin(x.load_angle));
    const S viscous = constant(&DriveSpec::load_viscous) * x.load_speed;
    return gravity + viscous + sum(Site::load, x);
  }

  /// What the kinematics add to the torsion of a rigid instant, without them.
  S kinematics(const Instant<S>& rigid) const { return sum(Site::kinematics, rigid); }

  /// What they add to its rate along the motion and, where it is entered, the torque's rate.
  S kinematics_rate(const Instant<S>& rigid) const {
    S total(0.0);
    for (const EffectUse& use : model_.effects()) {
      if (use.site == Site::kinematics) total += kinematic_rate(use, rigid);
    }
    return total;
  }

  /// Adds the kinematic terms to the torsion and to its rate.
  void add_kinematics(Instant<S>& x) const {
    if (!model_.has(Site::kinematics)) return;
    const Instant<S> rigid = x;
    x.torsion += kinematics(rigid);
    x.torsion_rate += kinematics_rate(rigid);
  }

  /// What the transmission returns to a shaft that it turns with, by virtual work: the integral of
  /// de/dtheta over the torque for kinematics e, of dt/dtheta over the torsion for terms t of the
  /// torsion law; by the midpoint, which is exact for terms affine in torque or torsion. Beside
  /// tau/N on the motor, less than tau on the load. x: with the law's torsion; rigid: without.
  S motor_reaction(const Instant<S>& rigid, const Instant<S>& x) const {
    return reactions(rigid, x, &EffectUse::follows_motor, &Instant<S>::motor_angle);
  }
  S load_reaction(const Instant<S>& rigid, const Instant<S>& x) const {
    return reactions(rigid, x, &EffectUse::follows_load, &Instant<S>::load_angle);
  }

  /// Enters the true motor torque behind a recorded one: the fixed point of
  /// true = recorded - term(true), as gains of instruments are well below one.
  void set_motor_torque(Instant<S>& x, const S& recorded) const {
    x.motor_torque = recorded;
    if (!model_.has(Site::motor_torque_signal)) return;
    for (int k = 0; k < 40; ++k) {
      x.motor_torque = recorded - sum(Site::motor_torque_signal, x);
    }
  }

  /// Turns a recorded transmitted torque and its rate into the true ones behind them, likewise.
  void undo_torque_sensor(Instant<S>& x) const {
    if (!model_.has(Site::torque_signal)) return;
    const S recorded = x.transmitted_torque;
    const S recorded_rate = x.transmitted_torque_rate;
    for (int k = 0; k < 40; ++k) {
      x.transmitted_torque = recorded - sum(Site::torque_signal, x);
    }
    for (int k = 0; k < 40; ++k) {
      x.transmitted_torque_rate = recorded_rate - difference(1e-4, [&](double by) {
                                    Instant<S> moved = x;
                                    moved.time += S(by);
                                    moved.motor_angle += by * x.motor_speed;
                                    moved.transmitted_torque += by * x.transmitted_torque_rate;
                                    return sum(Site::torque_signal, moved);
                                  });
    }
  }

  /// The rate of the true torque behind a recorded one, likewise, where the sensor remembers.
  S true_torque_rate(Instant<S> x, double recorded_rate) const {
    const double step = std::min(1e-4, 1e-3 / (std::abs(recorded_rate) + 1e-300));
    x.transmitted_torque_rate = S(recorded_rate);
    for (int k = 0; k < 40; ++k) {
      S added(0.0);
      for (const EffectUse& use : model_.effects()) {
        if (use.site != Site::torque_signal) continue;
        std::vector<S> rates(use.states, S(0.0));
        if (use.states > 0) memory_rate(use, x, rates);
        added += difference(step, [&](double by) { return term_moved(use, x, rates, by); });
      }
      x.transmitted_torque_rate = recorded_rate - added;
    }
    return x.transmitted_torque_rate;
  }

  /// Time derivatives of the effects' memory. Kinematics see the rigid motion, without themselves.
  void memory_rates(const Instant<S>& rigid, const Instant<S>& x, std::span<S> rates) const {
    for (const EffectUse& use : model_.effects()) {
      if (use.states == 0) continue;
      const Instant<S>& seen = use.site == Site::kinematics ? rigid : x;
      memory_rate(use, seen, rates.subspan(use.state, use.states));
    }
  }

 private:
  S law(std::size_t which, const S& x) const {
    const auto starts = model_.law_starts();
    const auto coefficients = p_.subspan(starts[which], starts[which + 1] - starts[which]);
    return evaluate(model_.law(which, coefficients), x, coefficients);
  }

  S term(const EffectUse& use, const Instant<S>& x) const {
    const auto parameters = p_.subspan(use.parameter, use.parameters);
    const auto memory = memory_.subspan(use.state, use.states);
    const auto term_of = functions_at<S>(*use.row).term;
    return use.across ? term_of(across_transmission(x), parameters, memory)
                      : term_of(x, parameters, memory);
  }

  void memory_rate(const EffectUse& use, const Instant<S>& x, std::span<S> rates) const {
    functions_at<S>(*use.row).rate(use.across ? across_transmission(x) : x,
                                   p_.subspan(use.parameter, use.parameters),
                                   memory_.subspan(use.state, use.states), rates);
  }

  // Sixth-order differences: orders of 200 at the motor and 1000 at the load to 5e-7, of 10 to
  // 1e-12.
  S reaction(Site site, Instant<S> x, S Instant<S>::*over, bool EffectUse::*follows,
             S Instant<S>::*angle) const {
    const S whole = x.*over;
    x.*over = 0.5 * whole;
    S slope(0.0);
    for (const EffectUse& use : model_.effects()) {
      if (use.site != site || !(use.*follows)) continue;
      slope += difference(angle == &Instant<S>::motor_angle ? 1e-3 : 1e-4, [&](double by) {
        Instant<S> moved = x;
        moved.*angle += S(by);
        return term(use, moved);
      });
    }
    return whole * slope;
  }

  S reactions(const Instant<S>& rigid, const Instant<S>& x, bool EffectUse::*follows,
              S Instant<S>::*angle) const {
    return reaction(Site::kinematics, rigid, &Instant<S>::transmitted_torque, follows, angle) +
           reaction(Site::transmission, x, &Instant<S>::torsion, follows, angle);
  }

  template <class Function>
  static S difference(double step, const Function& function) {
    constexpr double kWeights[] = {3.0 / 4.0, -3.0 / 20.0, 1.0 / 60.0};
    S slope(0.0);
    for (int k = 1; k <= 3; ++k) {
      const S ahead = function(k * step);
      const S behind = function(-k * step);
      slope += (kWeights[k - 1] / step) * (ahead - behind);
    }
    return slope;
  }

  // Sixth-order differences over a step that turns no shaft by more than 0.03 rad, twists by no
  // more than 1.5e-6 rad where the term follows the torsion, loads by no more than 0.003 Nm where
  // it follows the torque, and moves no memory, which kinematics hold in units of its own, by more
  // than 0.003: 1e-9 of the rate or better.
  S kinematic_rate(const EffectUse& use, const Instant<S>& x) const {
    const double fastest = std::abs(real_part(x.motor_speed)) + std::abs(real_part(x.load_speed));
    double step = 0.01 / (1.0 + fastest);
    const double twist = std::abs(real_part(x.torsion_rate));
    if (use.follows_torsion && twist * step > 5e-7) step = 5e-7 / twist;
    const double loading = std::abs(real_part(x.transmitted_torque_rate));
    if (use.follows_torque && loading * step > 1e-3) step = 1e-3 / loading;
    std::vector<S> memory_rates(use.states, S(0.0));
    if (use.states > 0) memory_rate(use, x, memory_rates);
    for (const S& one : memory_rates) {
      const double moving = std::abs(real_part(one));
      if (moving * step > 1e-3) step = 1e-3 / moving;
    }
    return difference(step, [&](double by) { return term_moved(use, x, memory_rates, by); });
  }

  S term_moved(const EffectUse& use, Instant<S> x, std::span<const S> memory_rates,
               double dt) const {
    x.time += S(dt);
    x.motor_angle += dt * x.motor_speed;
    x.load_angle += dt * x.load_speed;
    x.torsion += dt * x.torsion_rate;
    x.transmitted_torque += dt * x.transmitted_torque_rate;
    std::vector<S> memory(use.states);
    for (std::size_t k = 0; k < use.states; ++k) {
      memory[k] = memory_[use.state + k] + dt * memory_rates[k];
    }
    return functions_at<S>(*use.row).term(x, p_.subspan(use.parameter, use.parameters), memory);
  }

  const DriveModel& model_;
  std::span<const S> p_;
  std::span<const S> memory_;
};

}  // namespace flexspline
