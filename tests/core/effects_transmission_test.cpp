// Effects of the transmission against their closed forms.
#include <cmath>

#include <gtest/gtest.h>

#include "effect_terms.hpp"
#include "motions.hpp"

namespace flexspline {
namespace {

// Up to 1 in 2 s, held for 30 s: each branch charges and relaxes, however coarse the samples.
TEST(ViscoelasticCreep, RelaxesAfterARampWhateverTheSampling) {
  for (int per_second : {1, 7, 1000}) {
    Path path;
    for (int i = 0; i <= 32 * per_second; ++i) {
      Instant<double> x;
      x.time = static_cast<double>(i) / per_second;
      x.torsion = std::min(0.5 * x.time, 1.0);
      path.push_back(x);
    }
    const auto torque = terms_of(
        "viscoelastic_creep",
        {{"stiffness", 40.0}, {"time_constant", 0.5}, {"stiffness", 9.0}, {"time_constant", 12.0}},
        path);
    for (std::size_t i = 0; i < path.size(); ++i) {
      const double t = path[i].time;
      double expected = 0.0;
      for (const auto& [k, T] : {std::pair{40.0, 0.5}, std::pair{9.0, 12.0}}) {
        const double charged = k * 0.5 * T * -std::expm1(-std::min(t, 2.0) / T);
        expected += charged * std::exp(-std::max(t - 2.0, 0.0) / T);
      }
      ASSERT_NEAR(torque[i], expected, 1e-11) << "at " << t << " s";
    }
  }
}

TEST(ViscoelasticCreep, LosesMostAtTheFrequencyOfItsTimeConstant) {
  constexpr int kPerCycle = 4000;
  const auto motion = harmonic_motion({0.3}, kPerCycle, 40);
  for (double wT : {0.1, 1.0, 10.0}) {
    const auto torque =
        terms_of("viscoelastic_creep", {{"stiffness", 20.0}, {"time_constant", wT / (2.0 * kPi)}},
                 instants_of(motion));
    const double expected = kPi * 20.0 * 0.09 * wT / (1.0 + wT * wT);
    const std::size_t last = motion.time.size() - 1;
    EXPECT_NEAR(work(motion, torque, last - kPerCycle, last), expected, 1e-5 * expected);
  }
}

TEST(Backlash, IsFlatWithinItsGapAndLinearBeyond) {
  constexpr double kGap = 1e-3;
  constexpr double kRounding = 1e-6;
  for (double phi : grid(-4e-3, 4e-3, 801)) {
    Instant<double> x;
    x.torsion = phi;
    const double effective =
        phi + term_at("backlash", {{"half_gap", kGap}, {"rounding", kRounding}}, x);
    const double dead = phi - std::clamp(phi, -kGap, kGap);
    EXPECT_NEAR(effective, dead, 0.5 * kRounding + 1e-9) << "at " << phi;
    if (std::abs(std::abs(phi) - kGap) < 1e-4) continue;
    EXPECT_NEAR(effective, dead, 1e-8) << "at " << phi;
  }
}

TEST(Backlash, NeverTurnsTheTorsionBack) {
  const auto phi = grid(-3e-4, 3e-4, 1000);
  for (double rounding : {1e-8, 2e-5, 1e-3}) {
    const auto lost = terms_of("backlash", {{"half_gap", 1e-4}, {"rounding", rounding}},
                               along(&Instant<double>::torsion, phi));
    for (std::size_t i = 1; i < phi.size(); ++i) {
      EXPECT_GE(phi[i] + lost[i] - phi[i - 1] - lost[i - 1], -1e-18);
    }
  }
}

double carried(double play, double gap, double friction) {
  return -gap * play / std::hypot(play, friction);
}

TEST(PlayBacklash, FollowsThePlayOperator) {
  const std::vector<double> torque = {0.0, 3.0, 10.0, 5.0, 2.0, -10.0, -7.0, -1.0};
  const std::vector<double> play = {0.0, 0.0, 6.0, 6.0, 6.0, -6.0, -6.0, -5.0};
  const auto lost = terms_of("play_backlash", {{"half_gap", 0.01}, {"friction", 4.0}},
                             along(&Instant<double>::transmitted_torque, torque));
  for (std::size_t i = 0; i < play.size(); ++i) {
    EXPECT_NEAR(lost[i], carried(play[i], 0.01, 4.0), 1e-16) << "sample " << i;
  }
}

// The energy that friction takes from a cycle: 4 T times half the motion of the joint.
TEST(PlayBacklash, LosesFrictionTimesTheMotionOfTheJoint) {
  for (double amplitude : {3.0, 6.0, 20.0}) {
    std::vector<double> torque;
    for (double t : grid(0.0, 2.0, 80000)) torque.push_back(amplitude * std::sin(2.0 * kPi * t));
    const auto lost = terms_of("play_backlash", {{"half_gap", 0.01}, {"friction", 4.0}},
                               along(&Instant<double>::transmitted_torque, torque));
    const std::vector<double> one(lost.end() - 40001, lost.end());
    const std::vector<double> tau(torque.end() - 40001, torque.end());
    const double reach = std::max(amplitude - 4.0, 0.0);
    EXPECT_NEAR(-integral(tau, one), -4.0 * 4.0 * carried(reach, 0.01, 4.0), 1e-8);
  }
}

TEST(SoftWindup, GoesFromK1ToK3AndGivesBackItsWork) {
  constexpr double kK1 = 15e4;
  constexpr double kK3 = 26e4;
  const Parameters hardening = {{"stiffening", kK3 - kK1}, {"knee", 5e-4}};
  const auto slope = [&](double phi) {
    const double h = 1e-7;
    const auto torque =
        terms_of("soft_windup", hardening, along(&Instant<double>::torsion, {phi - h, phi + h}));
    return kK1 + (torque[1] - torque[0]) / (2.0 * h);
  };
  EXPECT_NEAR(slope(0.0), kK1, 1e-6 * kK1);
  EXPECT_NEAR(slope(0.01), kK3, 1e-6 * kK3);
  EXPECT_NEAR(slope(-0.01), kK3, 1e-6 * kK3);
  const auto motion = harmonic_motion({2e-3, 1e-3}, 4000);
  const auto torque = terms_of("soft_windup", hardening, instants_of(motion));
  double net = 0.0;
  for (std::size_t i = 1; i < torque.size(); ++i) net += torque[i] * motion.velocity[i] / 4000.0;
  EXPECT_NEAR(net, 0.0, 1e-10);
}

// Law f = K phi_e behind a spring: tau = phi / (1/K + c).
TEST(SeriesCompliance, IsTwoSpringsInSeries) {
  constexpr double kGear = 6.7e3;
  constexpr double kBar = 2.1e4;
  Instant<double> x;
  x.torsion = 1e-3;
  x.transmitted_torque = 1e-3 / (1.0 / kGear + 1.0 / kBar);
  const double effective =
      x.torsion + term_at("series_compliance", {{"compliance", 1.0 / kBar}}, x);
  EXPECT_NEAR(kGear * effective, x.transmitted_torque, 1e-12);
}

TEST(DahlHysteresis, IsAnExponentialFromEachReversalOnWhateverTheSampling) {
  constexpr double kSlip = 0.3;
  for (double step : {1.0, 0.25, 1.0 / 256.0}) {
    const auto motion = zigzag({0.0, 1.0, -1.0}, step);
    const auto torque =
        terms_of("dahl_hysteresis", {{"height", 5.0}, {"slip_length", kSlip}}, instants_of(motion));
    const auto turn = static_cast<std::size_t>(1.0 / step);
    const double top = 1.0 - std::exp(-1.0 / kSlip);
    for (std::size_t i = 0; i < torque.size(); ++i) {
      const double x = motion.position[i];
      const double expected =
          i <= turn ? 1.0 - std::exp(-x / kSlip) : -1.0 + (1.0 + top) * std::exp((x - 1.0) / kSlip);
      EXPECT_NEAR(torque[i] / 5.0, expected, 1e-13) << "step " << step << " at " << x;
    }
  }
}

TEST(DahlHysteresis, SettlesToALoopBetweenPlusAndMinusTanh) {
  for (double amplitude : {0.1, 0.3, 1.0}) {
    std::vector<double> turns = {0.0};
    for (int i = 0; i < 100; ++i) turns.insert(turns.end(), {amplitude, -amplitude});
    const auto torque = terms_of("dahl_hysteresis", {{"height", 5.0}, {"slip_length", 0.3}},
                                 along(&Instant<double>::torsion, turns));
    EXPECT_NEAR(torque.back(), -5.0 * std::tanh(amplitude / 0.3), 1e-12);
  }
}

TEST(BoucWen, HasItsHeightAfterALongWayInOneSample) {
  for (double exponent : {0.2, 1.0, 5.0}) {
    const auto torque =
        terms_of("bouc_wen", {{"height", 5.0}, {"slip_length", 1e-7}, {"exponent", exponent}},
                 along(&Instant<double>::torsion, {0.0, 0.1, -0.1}));
    EXPECT_NEAR(torque[1], 5.0, 1e-9) << exponent;
    EXPECT_NEAR(torque[2], -5.0, 1e-9) << exponent;
  }
}

Parameters lugre(double stribeck, double damping) {
  return {{"stiffness", 100.0},
          {"coulomb", 5.0},
          {"stribeck", stribeck},
          {"stribeck_rate", 0.2},
          {"damping", damping}};
}

Path at_constant_rate(double rate, double reach, int samples) {
  Path path;
  for (int i = 0; i <= samples; ++i) {
    Instant<double> x;
    x.torsion = reach * i / samples;
    x.time = x.torsion / rate;
    x.torsion_rate = rate;
    path.push_back(x);
  }
  return path;
}

TEST(LugreTorsion, SlidesAtItsStribeckCurve) {
  for (double rate : {-1.0, -0.1, 0.02, 0.2, 0.5}) {
    const auto path = at_constant_rate(rate, std::copysign(10.0, rate), 50);
    const double curve = 5.0 + 2.0 * std::exp(-std::pow(rate / 0.2, 2));
    EXPECT_NEAR(terms_of("lugre_torsion", lugre(2.0, 3.0), path).back(), std::copysign(curve, rate),
                1e-9);
  }
}

TEST(LugreTorsion, IsASpringAndADamperWhereItBarelyMoves) {
  const auto path = at_constant_rate(0.01, 1e-6, 10);
  EXPECT_NEAR(terms_of("lugre_torsion", lugre(0.0, 3.0), path).back(), 100.0 * 1e-6 + 3.0 * 0.01,
              1e-4);
}

TEST(LugreTorsion, IsDahlsWithoutStribeckAndDamping) {
  const auto path = instants_of(harmonic_motion({0.2, 0.1}, 400, 2));
  const auto one = terms_of("lugre_torsion", lugre(0.0, 0.0), path);
  const auto other = terms_of("dahl_hysteresis", {{"height", 5.0}, {"slip_length", 0.05}}, path);
  for (std::size_t i = 0; i < path.size(); ++i) EXPECT_NEAR(one[i], other[i], 1e-12);
}

}  // namespace
}  // namespace flexspline
