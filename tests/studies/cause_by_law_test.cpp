// Causes that are an effect's own law, on effects made up here.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "diagnosis/frame/coordinates.hpp"
#include "diagnosis/model/cause_by_law.hpp"
#include "drive_frame.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;

// A spring that follows the torsion late: s' = (phi - s)/T, tau += k (phi - s).
struct LateSpring {
  template <class S>
  static S term(const Instant<S>& x, std::span<const S> p, std::span<const S> z) {
    return p[0] * (x.torsion - z[0]);
  }
  // Exact for a torsion that is straight between the samples and starts from zero.
  template <class S>
  static void advance(const Instant<S>& from, const Instant<S>& to, std::span<const S> p,
                      std::span<S> z) {
    using std::exp;
    const S dt = to.time - from.time;
    const S slope = (to.torsion - from.torsion) / dt;
    const S left = exp(-dt / p[1]);
    z[0] = to.torsion - slope * p[1] + (z[0] - from.torsion + slope * p[1]) * left;
  }
  template <class S>
  static void rate(const Instant<S>& x, std::span<const S> p, std::span<const S> z,
                   std::span<S> dz) {
    dz[0] = (x.torsion - z[0]) / p[1];
  }
};

struct Rubbing {
  template <class S>
  static S term(const Instant<S>& x, std::span<const S> p, std::span<const S>) {
    return p[0] * smooth_sign(x.motor_speed, p[1]);
  }
};

struct Wobble {
  template <class S>
  static S term(const Instant<S>& x, std::span<const S> p, std::span<const S>) {
    using std::sin;
    return p[0] * sin(3.0 * x.load_angle + p[1]);
  }
};

EffectRow late_spring() {
  EffectRow row{.id = "late_spring",
                .coordinate = "lag",
                .site = Site::transmission,
                .equation = "tau += k (phi - s)",
                .parameters = {{"stiffness", "Nm/rad", 0.0, 1e9, 1e3, "made up", linear("of it")},
                               {"time_constant", "s", 1e-6, 1e6, 1.0, "made up",
                                shape("in which it follows", 0.01, 0.2, Scale::duration)}},
                .rigs = {Rig::locked, Rig::free, Rig::specimen},
                .states = 1};
  instantiate<LateSpring>(row);
  return row;
}

EffectRow rubbing() {
  EffectRow row{.id = "rubbing",
                .coordinate = "velocity",
                .site = Site::motor,
                .equation = "tau_f += c tanh(w/we)",
                .parameters = {{"coulomb", "Nm", 0.0, 1e9, 1.0, "made up", linear("of it")},
                               {"smoothing", "rad/s", 1e-9, 1e3, 1.0, "made up", sign_width()}},
                .rigs = {Rig::locked, Rig::free, Rig::specimen, Rig::servo}};
  instantiate<Rubbing>(row);
  return row;
}

EffectRow wobble(Site site) {
  EffectRow row{.id = "wobble",
                .coordinate = "load_angle",
                .site = site,
                .equation = "tau_l += a sin(3 theta_l + p)",
                .parameters = {{"amplitude", "Nm", 0.0, 1e9, 1.0, "made up", linear("of it")},
                               {"phase", "rad", -4.0, 4.0, 0.0, "made up", phase()}},
                .rigs = {Rig::free, Rig::servo}};
  instantiate<Wobble>(row);
  return row;
}

Reference reference(const Frame& f) {
  Reference known;
  known.motor_sign = rounded_sign(f.motor_speed, 2.0);
  known.torsion_sign = {{1.0, 1e-3}};
  return known;
}

// For a sinusoidal torsion the lag has a closed form: s behind phi by atan(w T), shorter by its
// cosine; what starts at zero has died out in the last of the rows.
TEST(CauseByLaw, CarriesAMemoryAlongEveryRecording) {
  Frame f = closed_form_frame(8000, 1e-2);
  const double w = 2.0;
  const double T = 0.7;
  f.torsion = 2e-3 * (w * f.time).sin();
  const auto row = cause_by_law(late_spring());
  ASSERT_TRUE(row);
  ASSERT_EQ(row->forms.size(), 1U);
  const CauseForm& form = row->forms.front();
  EXPECT_TRUE(form.nonnegative);
  const Columns columns = form.columns(Equation::torsion, f, reference(f), std::vector<double>{T});
  ASSERT_EQ(columns.size(), 1U);
  const double lag = std::atan(w * T);
  const ArrayXd settled = 2e-3 * ((w * f.time).sin() - std::cos(lag) * (w * f.time - lag).sin());
  // What a sine differs from its chords by, x'' dt^2/8.
  const double chord = 2e-3 * w * w * f.interval * f.interval / 8.0;
  for (const Segment& s : f.segments) {
    const auto late = [&](const ArrayXd& x) { return x.segment(s.first + 2000, 2000); };
    EXPECT_LT((late(columns[0]) - late(settled)).abs().maxCoeff(), 1.01 * chord);
  }
  const auto shapes = form.shapes(f);
  ASSERT_EQ(shapes.size(), 1U);
  EXPECT_DOUBLE_EQ(shapes[0].lower, 0.01 * f.duration);
  EXPECT_DOUBLE_EQ(shapes[0].upper, 0.2 * f.duration);
}

TEST(CauseByLaw, OfAFrictionHasTheDryFrictionsRoundingAndIsSoughtAcrossTheTransmission) {
  const Frame f = closed_form_frame();
  const auto row = cause_by_law(rubbing());
  ASSERT_TRUE(row);
  ASSERT_EQ(row->forms.size(), 3U) << "at the motor, across, across with a width of its own";
  const auto known = reference(f);
  const auto at_motor = row->forms[0].columns(Equation::motor, f, known, {});
  EXPECT_LT((at_motor[0] - known.motor_sign).abs().maxCoeff(), 1e-12);
  const auto across = row->forms[1].columns(Equation::torsion, f, known, {});
  EXPECT_LT((across[0] - rounded_sign(f.torsion_rate, 1e-3)).abs().maxCoeff(), 1e-12);
  EXPECT_TRUE(row->forms[1].friction);
  EXPECT_TRUE(row->forms[2].extends);
  const double width = 0.05 * f.rate_range;
  const auto own = row->forms[2].columns(Equation::torsion, f, known, std::vector<double>{width});
  EXPECT_LT((own[0] - (f.torsion_rate / width).tanh()).abs().maxCoeff(), 1e-12);
}

TEST(CauseByLaw, SplitsAPhaseIntoSineAndCosineAndPutsItTogetherAgain) {
  const Frame f = closed_form_frame();
  const auto row = cause_by_law(wobble(Site::load));
  ASSERT_TRUE(row);
  ASSERT_EQ(row->forms.size(), 2U) << "the load's equation, and the motor's of a servo";
  const CauseForm& form = row->forms.front();
  EXPECT_FALSE(form.nonnegative);
  const auto columns = form.columns(Equation::load, f, reference(f), {});
  ASSERT_EQ(columns.size(), 2U);
  EXPECT_EQ(form.terms(f).size(), 2U);
  const Eigen::VectorXd b = Eigen::Vector2d(0.3, -0.4);
  const Counterpart made = form.counterpart({f, {}, b, {}, {}, 0.0});
  ASSERT_EQ(made.effects.size(), 1U);
  const auto& p = made.effects[0].parameters;
  EXPECT_EQ(p[0].first, "amplitude");
  EXPECT_NEAR(p[0].second, 0.5, 1e-15);
  const ArrayXd fitted = 0.3 * columns[0] - 0.4 * columns[1];
  const ArrayXd said = p[0].second * (3.0 * f.load_angle + p[1].second).sin();
  EXPECT_LT((fitted - said).abs().maxCoeff(), 1e-14);
}

TEST(CauseByLaw, OfTheTorqueSensorIsSeenByEveryEquationThatUsesIt) {
  const Frame f = closed_form_frame();
  EffectRow seen = wobble(Site::torque_signal);
  const auto row = cause_by_law(seen);
  ASSERT_TRUE(row);
  const CauseForm& form = row->forms.front();
  const auto load = form.columns(Equation::load, f, reference(f), {});
  const auto motor = form.columns(Equation::motor, f, reference(f), {});
  EXPECT_LT((load[0] + f.ratio * motor[0]).abs().maxCoeff(), 1e-12);
}

TEST(CauseByLaw, IsNoneOfAnAngleOrOfWhatDoesNotSayHowItIsSought) {
  EXPECT_FALSE(cause_by_law(wobble(Site::kinematics)));
  EffectRow silent = wobble(Site::load);
  silent.parameters[1].search = {};
  EXPECT_FALSE(cause_by_law(silent));
  EffectRow without_amplitude = wobble(Site::load);
  without_amplitude.parameters[0].search = held();
  EXPECT_FALSE(cause_by_law(without_amplitude));
}

}  // namespace
}  // namespace flexspline::studies
