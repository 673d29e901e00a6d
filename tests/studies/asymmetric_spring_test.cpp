// A spring that is stiffer on one side, and zeros that are off: of the baseline, no names.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "autoregression.hpp"
#include "diagnosis/model/cause.hpp"
#include "diagnosis/search/search.hpp"
#include "diagnosis/search/selection.hpp"
#include "diagnosis_checks.hpp"

namespace flexspline::studies {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

ConcealedCase disturbed(Rig rig, std::uint64_t seed, std::string disturbance,
                        std::vector<data::HiddenEffect> effects = {}) {
  ConcealPlan plan;
  plan.rig = rig;
  plan.seed = seed;
  plan.disturbances = {std::move(disturbance)};
  plan.effects = std::move(effects);
  auto made = conceal(plan);
  EXPECT_TRUE(made.has_value()) << (made ? "" : made.error().message());
  return made ? *std::move(made) : ConcealedCase{};
}

double applied(const ConcealedCase& hidden, const std::string& parameter) {
  for (const auto& one : hidden.answer.disturbances.front().parameters) {
    if (one.name == parameter) return one.value;
  }
  return kNotComputed;
}

/// A motion in closed form under a torque: what a law of the torsion gives, dry friction, noise of
/// 0.02 Nm.
template <class Law>
Frame recorded(const Law& law) {
  Frame frame = closed_form_frame();
  frame.torque = law(frame.torsion) + 4.0 * (frame.torsion_rate / 0.02).tanh() +
                 0.02 * coloured_noise(frame.rows(), 0.0, 17);
  frame.equations = {Equation::torsion};
  frame.measure_torsion();
  frame.torque_range = frame.torque.abs().maxCoeff();
  return frame;
}

Eigen::ArrayXd hardening(const Eigen::ArrayXd& x, double cube = 1e9) {
  return 5e3 * x + cube * x.cube();
}

/// What the trial of the part adds to a frame, over its f.
double excess_found(const Frame& frame) {
  const auto findings = fit_baseline(frame);
  EXPECT_TRUE(findings.has_value());
  if (!findings) return kNotComputed;
  const auto trials = try_causes(frame, *findings);
  EXPECT_EQ(trials.front().cause.row->id, "asymmetric_spring");
  return trials.front().fit.model.coefficients.back()[0];
}

// tau = f(x) (1 + a sgn x) in closed form: the part is the best of all, and its coefficient a.
TEST(AsymmetricSpring, IsFoundWithItsSize) {
  for (const double a : {0.03, -0.05}) {
    const Frame frame = recorded([&](const Eigen::ArrayXd& x) -> Eigen::ArrayXd {
      return hardening(x, 1e12) + a * hardening(x, 1e12).abs();
    });
    EXPECT_NEAR(excess_found(frame), a, 0.1 * std::abs(a));
  }
}

// A side that is stiffer the further out: f(x) (1 + a tanh(2 x/X)) differs by 2 a tanh 2 at most.
TEST(AsymmetricSpring, MayDifferMoreAndMore) {
  constexpr double kExcess = 0.04;
  const Frame frame = recorded([&](const Eigen::ArrayXd& x) -> Eigen::ArrayXd {
    return hardening(x) * (1.0 + kExcess * (2.0 * x / x.abs().maxCoeff()).tanh());
  });
  const auto findings = fit_baseline(frame);
  ASSERT_TRUE(findings);
  const auto trials = try_causes(frame, *findings);
  const auto part = std::ranges::find_if(
      trials, [](const Trial& trial) { return trial.cause.row->id == "asymmetric_spring"; });
  EXPECT_GT(part->gain, 0.999 * trials.front().gain) << "an offset of the torque is alike";
  EXPECT_EQ(part->cause.shape.size(), 1U);
  EXPECT_NEAR(part->fit.model.coefficients.back()[0], kExcess * std::tanh(2.0), 0.004);
  const Eigen::ArrayXd& left = part->fit.residual[index_of(Equation::torsion)];
  EXPECT_LT(std::sqrt(left.square().mean()), 1.05 * 0.02);
}

// A side that is a tenth stiffer than in the middle, the other a tenth softer.
TEST(AsymmetricSpring, MayDifferByAFifth) {
  constexpr double kExcess = 0.1;
  const Frame frame = recorded([&](const Eigen::ArrayXd& x) -> Eigen::ArrayXd {
    return hardening(x) + kExcess * hardening(x).abs();
  });
  const auto s = select_causes(frame, Limits{}, {});
  ASSERT_TRUE(s) << s.error().message();
  const DriveModel& model = s->final.fit.model;
  ASSERT_EQ(model.causes.size(), 1U);
  EXPECT_EQ(model.causes.front().row->id, "asymmetric_spring");
  EXPECT_NEAR(model.coefficients.front()[0], kExcess, 0.004);
}

// An offset of 1.5 % explains what sides that differ more and more do nearly as well, with a number
// less.
TEST(AsymmetricSpring, LeavesAnOffsetItsName) {
  const Frame frame = recorded([](const Eigen::ArrayXd& x) -> Eigen::ArrayXd {
    return hardening(x) + 0.015 * hardening(x).abs().maxCoeff();
  });
  const auto s = select_causes(frame, Limits{}, {});
  ASSERT_TRUE(s) << s.error().message();
  std::vector<std::string> ids;
  for (const ActiveCause& cause : s->final.fit.model.causes) ids.emplace_back(cause.row->id);
  EXPECT_THAT(ids, Contains("torque_sensor_offset"));
  EXPECT_THAT(ids, testing::Not(Contains("asymmetric_spring")));
}

class Disturbed : public testing::TestWithParam<Rig> {};

TEST_P(Disturbed, AnAsymmetricSpringIsNoMissingPhysics) {
  for (const std::uint64_t seed : {5U, 9U}) {
    const ConcealedCase hidden = disturbed(GetParam(), seed, "asymmetric_spring");
    const Diagnosis d = diagnosed(hidden.recordings);
    EXPECT_THAT(names(d), ElementsAre()) << seed;
    EXPECT_EQ(d.verdict, Verdict::adequate) << seed << ": " << d.says;
    if (applied(hidden, "excess") < 0.03) continue;
    EXPECT_THAT(d.notes, Contains(HasSubstr("stiffer at positive torsion"))) << seed;
  }
}

TEST_P(Disturbed, AFarZeroIsNoMissingPhysics) {
  for (const std::uint64_t seed : {5U, 9U}) {
    const ConcealedCase hidden = disturbed(GetParam(), seed, "encoder_zero");
    const Diagnosis d = diagnosed(hidden.recordings);
    EXPECT_THAT(names(d), ElementsAre()) << seed;
    EXPECT_EQ(d.verdict, Verdict::adequate) << seed << ": " << d.says;
  }
}

TEST_P(Disturbed, AnEffectBesideItKeepsItsName) {
  const ConcealedCase hidden =
      disturbed(GetParam(), 9, "asymmetric_spring", {{"presliding_hysteresis", 0.06}});
  EXPECT_THAT(names(diagnosed(hidden.recordings)), ElementsAre("presliding_hysteresis"));
}

// An arm that hangs anywhere but at the encoder's zero: gravity's cosine is no offset of the
// torque.
TEST(DisturbedServo, TheZeroOfAnArmIsNoMissingPhysics) {
  for (const std::uint64_t seed : {5U, 9U}) {
    const ConcealedCase hidden = disturbed(Rig::servo, seed, "encoder_zero");
    const Diagnosis d = diagnosed(hidden.recordings);
    EXPECT_THAT(names(d), ElementsAre()) << seed;
    EXPECT_EQ(d.verdict, Verdict::adequate) << seed << ": " << d.says;
    if (std::abs(applied(hidden, "zero")) < 0.02) continue;
    EXPECT_THAT(d.notes, Contains(HasSubstr("deg of its encoder"))) << seed;
  }
}

TEST(DisturbedServo, AnOffsetBesideItKeepsItsName) {
  const ConcealedCase hidden =
      disturbed(Rig::servo, 9, "encoder_zero", {{"motor_torque_offset", 0.06}});
  EXPECT_THAT(names(diagnosed(hidden.recordings)), ElementsAre("motor_torque_offset"));
}

INSTANTIATE_TEST_SUITE_P(Rigs, Disturbed, testing::Values(Rig::locked, Rig::free, Rig::specimen),
                         [](const auto& rig) { return std::string(name_of(rig.param)); });

}  // namespace
}  // namespace flexspline::studies
