#pragma once

#include <memory>
#include <span>
#include <vector>

#include "flexspline/core/drive_spec.hpp"
#include "flexspline/core/effect.hpp"
#include "flexspline/core/law_scalar.hpp"

namespace flexspline {

/// An effect of a drive: where its parameters and its memory lie.
struct EffectUse {
  const EffectRow* row = nullptr;
  std::size_t parameter = 0;
  std::size_t parameters = 0;
  std::size_t state = 0;
  std::size_t states = 0;
  bool follows_torsion = false;
};

/// The laws and effects of a drive, made once, for use at any scalar by DriveAt.
class DriveModel {
 public:
  /// Errors: a law or effect that cannot be made, or that a forward simulation cannot carry.
  /// signals: the instruments' effects that the rig takes into its equations. closed_loop: a
  /// controller makes the motor torque.
  static Result<DriveModel> make(const DriveSpec& drive, std::vector<DriveConstant> constants,
                                 std::vector<Site> signals, bool closed_loop = false);

  const DriveSpec& drive() const { return drive_; }
  std::span<const DriveConstant> constants() const { return constants_; }
  std::span<const EffectUse> effects() const { return effects_; }
  std::size_t parameters() const { return parameters_; }
  std::size_t memory() const { return memory_; }
  std::size_t first_constant() const { return first_constant_; }
  bool has(Site site) const;

  /// The law f (0), g^-1 (1) or h (2) with the coefficients that p has for it.
  template <class S>
  const Law& law(std::size_t which, std::span<const S> coefficients) const {
    bool same = true;
    const auto& made = laws_[which]->spec().coefficients;
    for (std::size_t k = 0; k < made.size(); ++k) same &= made[k] == real_part(coefficients[k]);
    if (!same) {
      std::vector<double> values;
      for (const S& c : coefficients) values.push_back(real_part(c));
      remake(which, std::move(values));
    }
    return *laws_[which];
  }

  /// Where the coefficients of that law start and how many there are.
  std::span<const std::size_t, 4> law_starts() const { return law_starts_; }

 private:
  void remake(std::size_t which, std::vector<double> coefficients) const;

  DriveSpec drive_;
  std::vector<DriveConstant> constants_;
  std::vector<EffectUse> effects_;
  std::array<std::size_t, 4> law_starts_{};
  std::size_t first_constant_ = 0;
  std::size_t parameters_ = 0;
  std::size_t memory_ = 0;
  mutable std::array<std::unique_ptr<Law>, 3> laws_;
};

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
    return S(f(x.torsion) + g_inverse(S(x.torsion_rate / h(x.torsion))));
  }

  /// What the effects at a site add.
  S sum(Site site, const Instant<S>& x) const {
    S total(0.0);
    for (const EffectUse& use : model_.effects()) {
      if (use.row->site == site) total += term(use, x);
    }
    return total;
  }

  /// What crosses the transmission, all effects there included, which see the torsion law's torque.
  S transmitted(Instant<S>& x) const {
    x.transmitted_torque = torsion_law(x);
    return S(x.transmitted_torque + sum(Site::transmission, x));
  }

  /// tau_f + B1 omega + effects at the motor.
  S motor_losses(const Instant<S>& x) const {
    const S coulomb(constant(&DriveSpec::motor_coulomb) *
                    smooth_sign(x.motor_speed, constant(&DriveSpec::coulomb_width)));
    const S viscous(constant(&DriveSpec::motor_viscous) * x.motor_speed);
    return S(coulomb + viscous + sum(Site::motor, x));
  }

  /// B2 omega + m g l sin(theta) + effects at the load.
  S load_torque(const Instant<S>& x) const {
    using std::sin;
    const S weight(constant(&DriveSpec::load_mass) * constant(&DriveSpec::arm_length));
    const S gravity(weight * S(model_.drive().gravity * S(sin(x.load_angle))));
    const S viscous(constant(&DriveSpec::load_viscous) * x.load_speed);
    return S(gravity + viscous + sum(Site::load, x));
  }

  /// Adds the kinematic terms to the torsion and, along the motion, to its rate.
  void add_kinematics(Instant<S>& x) const {
    if (!model_.has(Site::kinematics)) return;
    const Instant<S> rigid = x;
    for (const EffectUse& use : model_.effects()) {
      if (use.row->site != Site::kinematics) continue;
      x.torsion += term(use, rigid);
      x.torsion_rate += kinematic_rate(use, rigid);
    }
  }

  /// Enters the true motor torque behind a recorded one: the fixed point of
  /// true = recorded - term(true), as gains of instruments are well below one.
  void set_motor_torque(Instant<S>& x, const S& recorded) const {
    x.motor_torque = recorded;
    if (!model_.has(Site::motor_torque_signal)) return;
    for (int k = 0; k < 40; ++k) {
      x.motor_torque = S(recorded - sum(Site::motor_torque_signal, x));
    }
  }

  /// Time derivatives of the effects' memory. Kinematics see the rigid motion, without themselves.
  void memory_rates(const Instant<S>& rigid, const Instant<S>& x, std::span<S> rates) const {
    for (const EffectUse& use : model_.effects()) {
      if (use.states == 0) continue;
      const Instant<S>& seen = use.row->site == Site::kinematics ? rigid : x;
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
    return functions_at<S>(*use.row).term(x, p_.subspan(use.parameter, use.parameters),
                                          memory_.subspan(use.state, use.states));
  }

  void memory_rate(const EffectUse& use, const Instant<S>& x, std::span<S> rates) const {
    functions_at<S>(*use.row).rate(x, p_.subspan(use.parameter, use.parameters),
                                   memory_.subspan(use.state, use.states), rates);
  }

  // Sixth-order differences over a step that turns no shaft by more than 0.03 rad and, where the
  // term follows the torsion, twists by no more than 1.5e-6 rad: 1e-9 of the rate or better.
  S kinematic_rate(const EffectUse& use, const Instant<S>& x) const {
    const double fastest = std::abs(real_part(x.motor_speed)) + std::abs(real_part(x.load_speed));
    double step = 0.01 / (1.0 + fastest);
    const double twist = std::abs(real_part(x.torsion_rate));
    if (use.follows_torsion && twist * step > 5e-7) step = 5e-7 / twist;
    std::vector<S> memory_rates(use.states, S(0.0));
    if (use.states > 0) memory_rate(use, x, memory_rates);
    constexpr double kWeights[] = {3.0 / 4.0, -3.0 / 20.0, 1.0 / 60.0};
    S rate(0.0);
    for (int k = 1; k <= 3; ++k) {
      const S ahead = term_moved(use, x, memory_rates, k * step);
      const S behind = term_moved(use, x, memory_rates, -k * step);
      rate += S((kWeights[k - 1] / step) * S(ahead - behind));
    }
    return rate;
  }

  S term_moved(const EffectUse& use, Instant<S> x, std::span<const S> memory_rates,
               double dt) const {
    x.time += S(dt);
    x.motor_angle += S(dt * x.motor_speed);
    x.load_angle += S(dt * x.load_speed);
    x.torsion += S(dt * x.torsion_rate);
    std::vector<S> memory(use.states);
    for (std::size_t k = 0; k < use.states; ++k) {
      memory[k] = S(memory_[use.state + k] + S(dt * memory_rates[k]));
    }
    return functions_at<S>(*use.row).term(x, p_.subspan(use.parameter, use.parameters), memory);
  }

  const DriveModel& model_;
  std::span<const S> p_;
  std::span<const S> memory_;
};

}  // namespace flexspline
