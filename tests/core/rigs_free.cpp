// The whole drive keeps its books: energy, and the limit of a rigid gear.
#include <numbers>

#include "claims/claims.hpp"
#include "rig_examples.hpp"

namespace flexspline {
namespace {

// A rig with the power put in and lost as further states.
class WithBooks final : public OdeSystem {
 public:
  explicit WithBooks(const RigSystem& rig) : rig_(rig) {}
  std::size_t states() const override { return rig_.states() + 2; }
  std::size_t parameters() const override { return rig_.parameters(); }
  void rate(double t, std::span<const double> y, std::span<const double> p,
            std::span<double> ydot) const override {
    keep(t, y, p, ydot);
  }
  void rate(double t, std::span<const Dual> y, std::span<const Dual> p,
            std::span<Dual> ydot) const override {
    keep(t, y, p, ydot);
  }

 private:
  template <class S>
  void keep(double t, std::span<const S> y, std::span<const S> p, std::span<S> ydot) const {
    using std::tanh;
    const std::size_t n = rig_.states();
    rig_.rate(t, y.first(n), p, ydot.first(n));
    const Instant<S> x = rig_.instant(t, y.first(n), p);
    const DriveSpec& d = rig_.drive();
    const S coulomb(d.motor_coulomb * S(tanh(S(x.motor_speed / d.coulomb_width))));
    const S motor(x.motor_speed * S(coulomb + S(d.motor_viscous * x.motor_speed)));
    const S load(S(x.load_speed * x.load_speed) * d.load_viscous);
    const double stiff = d.torsion.f.coefficients[0] / d.torsion.f.scale;
    const double cubic = d.torsion.f.coefficients[1] / std::pow(d.torsion.f.scale, 3);
    S ripple(0.0);
    for (const EffectSpec& effect : d.torsion.effects) {
      using std::sin;
      if (effect.effect != "stiffness_ripple") continue;
      const auto& q = effect.parameters;
      ripple += S(q[0].second * S(sin(S(S(q[1].second * x.motor_angle) + q[2].second))));
    }
    const S spring(x.torsion * S(stiff + S(cubic * S(x.torsion * x.torsion)) + ripple));
    ydot[n] = S(x.motor_torque * x.motor_speed);
    ydot[n + 1] = S(motor + load + S(x.torsion_rate * S(x.transmitted_torque - spring)));
    ydot[n + 1] += lost_in_joint(x, y[4]);
  }

  // What crosses a joint beyond the torque of its spring, T z, is friction.
  template <class S>
  S lost_in_joint(const Instant<S>& x, const S& play) const {
    const auto& effects = rig_.drive().torsion.effects;
    if (effects.empty() || effects[0].effect != "play_backlash") return S(0.0);
    const S turned(S(x.motor_speed / x.gear_ratio) - x.load_speed - x.torsion_rate);
    return S(turned * S(x.transmitted_torque - S(effects[0].parameters[1].second * play)));
  }
  const RigSystem& rig_;
};

double stored(const DriveSpec& d, const Instant<double>& x) {
  const double u = x.torsion / d.torsion.f.scale;
  const double spring = d.torsion.f.scale * (d.torsion.f.coefficients[0] * u * u / 2.0 +
                                             d.torsion.f.coefficients[1] * std::pow(u, 4) / 4.0);
  return 0.5 * d.motor_inertia * x.motor_speed * x.motor_speed +
         0.5 * d.load_inertia * x.load_speed * x.load_speed + spring +
         d.load_mass * d.gravity * d.arm_length * (1.0 - std::cos(x.load_angle));
}

/// What a compliance in series stores, turning with the motor or not: c tau^2/2.
double stored_in_series(const DriveSpec& d, const Instant<double>& x) {
  double compliance = 0.0;
  for (const EffectSpec& effect : d.torsion.effects) {
    if (effect.effect == "series_compliance") compliance += effect.parameters[0].second;
    if (effect.effect != "load_dependent_kinematic_error") continue;
    const auto& p = effect.parameters;
    compliance -= p[0].second * std::sin(p[1].second * x.motor_angle + p[2].second);
  }
  return 0.5 * compliance * x.transmitted_torque * x.transmitted_torque;
}

/// What a stiffness that turns with the motor stores beside f.
double stored_in_ripple(const DriveSpec& d, const Instant<double>& x) {
  double stiffness = 0.0;
  for (const EffectSpec& effect : d.torsion.effects) {
    if (effect.effect != "stiffness_ripple") continue;
    const auto& p = effect.parameters;
    stiffness += p[0].second * std::sin(p[1].second * x.motor_angle + p[2].second);
  }
  return 0.5 * stiffness * x.torsion * x.torsion;
}

/// What the rounded end of a joint's gap stores: b T (1 - 1/sqrt(z^2 + 1)).
double stored_in_joint(const DriveSpec& d, double play) {
  const auto& effects = d.torsion.effects;
  if (effects.empty() || effects[0].effect != "play_backlash") return 0.0;
  const auto& p = effects[0].parameters;
  return p[0].second * p[1].second * (1.0 - 1.0 / std::hypot(play, 1.0));
}

double worst_imbalance(double tolerance, std::vector<EffectSpec> effects = {}) {
  DriveSpec drive = example_drive();
  drive.torsion.effects = std::move(effects);
  const auto rig = made_rig(Rig::free, drive, {{{Quantity::motor_torque, sine(0.5, 1.0)}}, {}});
  const WithBooks system(*rig);
  const auto p = rig->parameter_vector();
  const auto times = instants(2.0, 50);
  const std::vector<double> start(system.states(), 0.0);
  const auto y = simulated(system, p, times, start, tolerance, 1e-3 * tolerance);
  double worst = 0.0;
  double turned_over = 0.0;
  double start_energy = 0.0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const auto state = std::span(y).subspan(i * system.states(), system.states());
    const auto x = rig->instant(times[i], state.first(rig->states()), p);
    const std::size_t books = rig->states();
    const double kept = stored(drive, x) + stored_in_series(drive, x) + stored_in_ripple(drive, x) +
                        stored_in_joint(drive, state[4]);
    // A kinematic error winds the gear up before anything has moved.
    if (i == 0) start_energy = kept;
    worst = std::max(worst, std::abs(kept - start_energy + state[books + 1] - state[books]));
    turned_over = std::max(turned_over, state[books]);
  }
  return worst / turned_over;
}

/// Of what was turned over, at tolerance 1e-10.
constexpr double kImbalance = 1e-8;

TEST(FreeRig, StoresOrLosesWhatIsPutIn) {
  const double coarse = worst_imbalance(1e-6);
  const double fine = worst_imbalance(1e-10);
  RecordProperty("imbalance", std::to_string(fine));
  std::printf("energy imbalance %.2e at 1e-6, %.2e at 1e-10\n", coarse, fine);
  EXPECT_LT(coarse, 1e-3);
  EXPECT_LT(fine, kImbalance);
  EXPECT_LT(fine, 1e-2 * coarse);
}

// What the kinematics return to motor and load closes the books: without it they are off by the
// work tau de, some percent here.
TEST(FreeRig, StoresOrLosesWhatIsPutInWithItsKinematics) {
  const EffectSpec error{"kinematic_error",
                         {{"amplitude", 1.5e-4}, {"order", 2.0}, {"phase", 0.4}}};
  const EffectSpec output{"output_kinematic_error",
                          {{"amplitude", 1e-4}, {"order", 1.0}, {"phase", 0.2}}};
  const EffectSpec series{"series_compliance", {{"compliance", 4.8e-5}}};
  const EffectSpec wave{"load_dependent_kinematic_error",
                        {{"compliance", 2e-5}, {"order", 2.0}, {"phase", 0.1}}};
  const EffectSpec joint{"play_backlash", {{"half_gap", 1e-4}, {"friction", 4.5}}};
  const EffectSpec ripple{"stiffness_ripple",
                          {{"stiffness", 600.0}, {"order", 2.0}, {"phase", 0.7}}};
  const std::vector<std::pair<std::string, std::vector<EffectSpec>>> cases = {
      {"an error of the motor", {error}},
      {"errors of both shafts", {error, output}},
      {"a spring in series", {series}},
      {"a spring that turns with the motor", {series, wave}},
      {"a stiffness that turns with the motor", {ripple}},
      {"a joint with play and friction", {joint}},
      {"all of them", {error, output, series, wave, ripple}}};
  for (const auto& [name, effects] : cases) {
    const double coarse = worst_imbalance(1e-6, effects);
    const double fine = worst_imbalance(1e-10, effects);
    std::printf("energy imbalance with %s: %.2e at 1e-6, %.2e at 1e-10\n", name.c_str(), coarse,
                fine);
    EXPECT_LT(fine, kImbalance) << name;
    EXPECT_LT(fine, 1e-2 * coarse) << name;
  }
  claims::expect("docs/simulation.md", "energy", {{"imbalance", kImbalance}});
}

// A gear a thousand times as stiff turns its load as one body.
TEST(FreeRig, TurnsAsOneBodyWhenTheGearIsStiff) {
  DriveSpec drive = example_drive();
  drive.motor_coulomb = drive.load_mass = 0.0;
  drive.torsion.f = law_spec("odd_polynomial", 1.0, {}, {1e8});
  drive.torsion.g_inverse = law_spec("odd_polynomial", 1.0, {}, {1e5});
  drive.torsion.h = law_spec("bounded_modulation", 1.0, {}, {});
  constexpr double kTorque = 0.2;
  const auto rig = made_rig(Rig::free, drive, {{{Quantity::motor_torque, constant(kTorque)}}, {}});
  const auto times = instants(5.0, 20);
  const auto y = simulated(*rig, rig->parameter_vector(), times, rig->rest(), 1e-10, 1e-12);
  const double inertia = reflected_inertia(drive) + drive.load_inertia;
  const double viscous = reflected_viscous(drive) + drive.load_viscous;
  for (std::size_t i = 1; i < times.size(); ++i) {
    const double expected =
        50.0 * kTorque / viscous * (1.0 - std::exp(-viscous / inertia * times[i]));
    EXPECT_NEAR(y[4 * i + 3] / expected, 1.0, 1e-5) << times[i];
    EXPECT_NEAR(y[4 * i + 1] / (50.0 * expected), 1.0, 1e-5) << times[i];
  }
}

TEST(FreeRig, FollowsItsReferenceUnderThePositionLoop) {
  const DriveSpec drive = example_drive();
  const auto rig = made_rig(Rig::free, drive, {{{Quantity::commanded_angle, sine(2.0, 0.2)}}, {}},
                            "position_loop");
  ASSERT_EQ(rig->states(), 5u);
  const auto times = instants(10.0, 100);
  const auto y = simulated(*rig, rig->parameter_vector(), times, rig->rest(), 1e-8, 1e-10);
  for (std::size_t i = 50; i < times.size(); ++i) {
    const double wanted = 2.0 * std::sin(2.0 * std::numbers::pi * 0.2 * times[i]);
    EXPECT_NEAR(y[5 * i], wanted, 0.1) << times[i];
  }
}

// A kinematic error of the wave generator makes torque at twice the motor's turning.
TEST(FreeRig, TakesKinematicsIntoItsTorsion) {
  DriveSpec drive = example_drive();
  const auto row = find_effect("kinematic_error");
  ASSERT_TRUE(row);
  EffectSpec error{"kinematic_error", {}};
  for (const auto& one : (*row)->parameters) {
    error.parameters.emplace_back(std::string(one.name), one.nominal);
  }
  drive.torsion.effects = {error};
  const auto rig = made_rig(Rig::free, drive, {{{Quantity::motor_torque, constant(0.1)}}, {}});
  const auto p = rig->parameter_vector();
  const double step = 1e-5;
  const std::vector<double> y = {0.4, 30.0, 0.4 / 50.0, 30.0 / 50.0};
  std::vector<double> ahead = y;
  std::vector<double> behind = y;
  for (int i : {0, 2}) {
    ahead[static_cast<std::size_t>(i)] += step * y[static_cast<std::size_t>(i) + 1];
    behind[static_cast<std::size_t>(i)] -= step * y[static_cast<std::size_t>(i) + 1];
  }
  const auto x = rig->instant(0.0, y, p);
  const double rate =
      (rig->instant(step, ahead, p).torsion - rig->instant(-step, behind, p).torsion) /
      (2.0 * step);
  EXPECT_NE(x.torsion, 0.0);
  EXPECT_NEAR(x.torsion_rate / rate, 1.0, 1e-6);
}

}  // namespace
}  // namespace flexspline
