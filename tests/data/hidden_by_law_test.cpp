// Effects concealed by their own law, on an effect made up here.
#include <cmath>

#include <gtest/gtest.h>

#include "bench/hidden_by_law.hpp"
#include "bench/hidden_law.hpp"

namespace flexspline::data {
namespace {

// s' = phi' - s/T, tau += k s.
struct Branch {
  template <class S>
  static S term(const Instant<S>&, std::span<const S> p, std::span<const S> z) {
    return p[0] * z[0];
  }
  template <class S>
  static void advance(const Instant<S>& from, const Instant<S>& to, std::span<const S> p,
                      std::span<S> z) {
    using std::exp;
    const S dt = to.time - from.time;
    if (!(real_part(dt) > 0.0)) return;
    const S settled = p[1] * (to.torsion - from.torsion) / dt;
    z[0] = settled + (z[0] - settled) * exp(-dt / p[1]);
  }
  template <class S>
  static void rate(const Instant<S>& x, std::span<const S> p, std::span<const S> z,
                   std::span<S> dz) {
    dz[0] = x.torsion_rate - z[0] / p[1];
  }
};

EffectRow branch(Site site) {
  EffectRow row{.id = "made_up_branch",
                .coordinate = "lag",
                .site = site,
                .equation = "tau += k s, s' = phi' - s/T",
                .parameters = {{"stiffness", "Nm/rad", 0.0, 1e9, 1e3, "made up", linear("of it")},
                               {"time_constant", "s", 1e-6, 1e6, 1.0, "made up",
                                shape("in which it relaxes", 0.05, 0.5, Scale::duration)}},
                .rigs = {Rig::locked, Rig::free},
                .states = 1};
  instantiate<Branch>(row);
  return row;
}

HiddenScale scale() {
  static const HiddenGear gear;
  HiddenScale s;
  s.gear = &gear;
  s.seed = 5;
  s.torque = 100.0, s.motor_torque = 3.0;
  s.motion = s.torsion = 2e-3, s.speed = 1e-2, s.mean_rate = 5.0;
  s.motor_speed = 1.0, s.clock_end = 40.0;
  s.recordings = {{"a", 0.0, 10.0}};
  return s;
}

// Along a torsion that rises evenly a branch goes to k T phi' as 1 - exp(-t/T).
TEST(HiddenByLaw, CarriesItsMemoryFromStepToStep) {
  const auto row = hidden_by_law(branch(Site::transmission));
  ASSERT_TRUE(row);
  const HiddenLaw law = row->make(scale(), 0.05);
  ASSERT_EQ(law.parameters.size(), 2U);
  const double k = law.parameters[0].value;
  const double T = law.parameters[1].value;
  EXPECT_GE(T, 0.5);
  EXPECT_LE(T, 5.0);
  const double rate = 1e-4;
  for (int i = 0; i <= 200; ++i) {
    const double t = 0.05 * i;
    const TorsionPoint point{rate * t, i == 0 ? 0.0 : 0.05, 0.0, rate, t};
    const double expected = k * T * rate * (1.0 - std::exp(-t / T));
    EXPECT_NEAR(law.transmission(point), expected, 1e-12 * k * T * rate);
    EXPECT_NEAR(law.transmission(point), expected, 1e-12 * k * T * rate) << "asked twice";
    law.remember(point);
  }
}

TEST(HiddenByLaw, IsAsLargeAsItsAmountAndBeginsAnew) {
  const auto row = hidden_by_law(branch(Site::transmission));
  const double once = row->make(scale(), 0.05).parameters[0].value;
  EXPECT_DOUBLE_EQ(row->make(scale(), 0.10).parameters[0].value, 2.0 * once);
  const HiddenLaw first = row->make(scale(), 0.05);
  first.remember({0.0, 0.0, 0.0, 0.0, 0.0});
  first.remember({1e-3, 0.1, 0.0, 0.0, 0.1});
  const HiddenLaw second = row->make(scale(), 0.05);
  EXPECT_EQ(second.transmission({0.0, 0.0, 0.0, 0.0, 0.0}), 0.0);
}

TEST(HiddenByLaw, IsNoneOfAnAngle) {
  EXPECT_FALSE(hidden_by_law(branch(Site::kinematics)));
  EXPECT_FALSE(hidden_by_law(branch(Site::load_angle_signal)));
  EffectRow silent = branch(Site::transmission);
  silent.parameters[0].search = {};
  EXPECT_FALSE(hidden_by_law(silent));
}

}  // namespace
}  // namespace flexspline::data
