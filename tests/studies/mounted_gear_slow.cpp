// Friction that grows with the load and remembers its way; mountings whose zeros differ; a gap in
// the freedom of f.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "diagnosis/names/gap_in_spring.hpp"
#include "diagnosis/search/zeros.hpp"
#include "diagnosis_checks.hpp"
#include "mounted_gear.hpp"

namespace flexspline::studies {
namespace {

TEST(LoadFriction, IsNamedThoughItsSignRemembersTheWay) {
  MountedGear gear;
  gear.load_share = 0.2;
  const Diagnosis d = diagnosed(gear.recordings());
  EXPECT_THAT(names(d),
              testing::UnorderedElementsAre("presliding_hysteresis", "load_dependent_friction"))
      << d.says;
  const auto load = std::ranges::find(d.causes, "load_dependent_friction", &Cause::effect);
  ASSERT_NE(load, d.causes.end());
  double sum = 0.0;
  for (const CauseParameter& p : load->parameters) sum += p.value;
  EXPECT_NEAR(sum, gear.load_share, 0.1 * gear.load_share);
}

TEST(LoadFriction, IsNotNamedWhereFrictionDoesNotGrow) {
  EXPECT_THAT(names(diagnosed(MountedGear{}.recordings())),
              testing::ElementsAre("presliding_hysteresis"));
}

Result<Frame> frame_of(const MountedGear& gear) { return make_frame(gear.recordings(), 16000); }

double mean_torsion(const Frame& f, std::size_t i) {
  return f.torsion.segment(f.segments[i].first, f.segments[i].count).mean();
}

// Every recording is some whole cycles about its zero, so its mean torsion is where that ends up:
// no further off than noise is through the spring.
TEST(Zeros, OfEveryMountingAreFoundAgain) {
  MountedGear gear;
  gear.zeros = {0.0, 0.013, -0.02};
  const auto frame = frame_of(gear);
  ASSERT_TRUE(frame) << frame.error().message();
  ASSERT_TRUE(frame->own_zeros);
  const auto selection = select_causes(*frame, Limits{}, {});
  ASSERT_TRUE(selection) << selection.error().message();
  Frame off = *frame;
  for (std::size_t i = 0; i < off.segments.size(); ++i) {
    const Segment& s = off.segments[i];
    off.torsion.segment(s.first, s.count) += 2e-4 * (i % 3 == 0 ? 1.0 : -1.0);
  }
  const auto fitted = with_fitted_zeros(off, selection->final);
  ASSERT_TRUE(fitted) << fitted.error().message();
  const double common = mean_torsion(*fitted, 0);
  const double of_noise = gear.noise / gear.stiffness;
  for (std::size_t i = 0; i < off.segments.size(); ++i) {
    EXPECT_NEAR(mean_torsion(*fitted, i), common, of_noise) << i;
    const Segment& was = off.segments[i];
    const double recorded = off.torsion[was.first] + was.zero;
    EXPECT_NEAR(fitted->torsion[was.first] + fitted->segments[i].zero, recorded, 1e-12) << i;
  }
}

TEST(Zeros, OfOneMountingAreNotTakenApart) {
  const auto frame = frame_of(MountedGear{});
  ASSERT_TRUE(frame) << frame.error().message();
  EXPECT_FALSE(frame->own_zeros);
}

Selection with_free_f(const MountedGear& gear) {
  const auto frame = frame_of(gear);
  EXPECT_TRUE(frame) << frame.error().message();
  Selection s;
  const auto baseline = fit_baseline(*frame);
  EXPECT_TRUE(baseline) << baseline.error().message();
  s.baseline = s.final = *baseline;
  return s;
}

TEST(GapInSpring, MakesItSoftInItsMiddle) {
  MountedGear gear;
  gear.friction = 0.0;
  EXPECT_NEAR(softness(*frame_of(gear), with_free_f(gear)), 1.0, 0.01);
  EXPECT_FALSE(may_hide_a_gap(*frame_of(gear), with_free_f(gear), {}));
  gear.half_gap = 4e-3;
  EXPECT_LT(softness(*frame_of(gear), with_free_f(gear)), 0.1);
  EXPECT_TRUE(may_hide_a_gap(*frame_of(gear), with_free_f(gear), {}));
}

// A column that is large and hardly seen: f counteracts it.
TEST(GapInSpring, MayHideBehindWhatAFreeFCounteracts) {
  MountedGear gear;
  gear.friction = 0.0;
  const Frame frame = *frame_of(gear);
  const Limits limits;
  const auto row = std::ranges::find(causes(), std::string_view("soft_windup"), &CauseRow::id);
  Trial windup;
  windup.cause = {&*row, &row->forms.front(), {}};
  windup.net_gain = 2.0 * limits.gain;
  windup.size = 1.2 * limits.half;
  windup.change = 0.1 * windup.size;
  Selection s = with_free_f(gear);
  s.last_field = {windup};
  EXPECT_TRUE(may_hide_a_gap(frame, s, limits));
  s.last_field.front().change = windup.size;
  EXPECT_FALSE(may_hide_a_gap(frame, s, limits)) << "it is seen in full";
  s.last_field.front() = windup;
  s.last_field.front().net_gain = 0.5 * limits.gain;
  EXPECT_FALSE(may_hide_a_gap(frame, s, limits)) << "it gains as noise does";
  s.last_field.front() = windup;
  Frame without = frame;
  without.travels = true;
  EXPECT_FALSE(may_hide_a_gap(without, s, limits)) << "an angle that travels winds up nothing";
  const CauseForm at_motor{.equation = "of the motor", .rigs = {}, .at = {Equation::motor}};
  s.last_field.front().cause.form = &at_motor;
  EXPECT_FALSE(may_hide_a_gap(frame, s, limits)) << "f has no part in the motor's equation";
}

// What is left of a spring with a gap when none of its slopes may be below 0.6 of the mean one.
TEST(GapInSpring, DoesNotFitIntoAFirmSpring) {
  MountedGear gear;
  gear.friction = 0.0;
  const auto misfit = [&](bool firm) {
    const auto frame = frame_of(gear);
    EXPECT_TRUE(frame) << frame.error().message();
    const auto fit = fit_baseline(firm ? with_firm_spring(*frame) : *frame);
    EXPECT_TRUE(fit) << fit.error().message();
    const auto& left = fit->fit.residual[index_of(Equation::torsion)];
    return std::sqrt(left.square().mean()) / gear.noise;
  };
  EXPECT_NEAR(misfit(true), misfit(false), 0.02) << "a spring that is firm";
  gear.half_gap = 4e-3;
  EXPECT_GT(misfit(true), 5.0 * misfit(false));
}

TEST(GapInSpring, IsNotRivalledByASpringThatIsSoftAtFirst) {
  const auto frame = frame_of(MountedGear{});
  ASSERT_TRUE(frame) << frame.error().message();
  const auto forms = [&](const Frame& f, std::string_view id) {
    return forms_on(*std::ranges::find(causes(), id, &CauseRow::id), f).size();
  };
  EXPECT_EQ(forms(*frame, "soft_windup"), 1U);
  EXPECT_EQ(forms(with_firm_spring(*frame), "soft_windup"), 0U);
  EXPECT_EQ(forms(with_firm_spring(*frame), "backlash"), forms(*frame, "backlash"));
}

TEST(GapInSpring, IsToldWhereAFirmSpringAndAGapPredictAsWell) {
  const auto row = std::ranges::find(causes(), std::string_view("backlash"), &CauseRow::id);
  Accepted gap;
  gap.trial.cause = {&*row, &row->forms.front(), {}};
  Selection named;
  named.accepted = {gap};
  Proof free_f;
  free_f.holdout.rmse_before = 4.0;
  free_f.holdout.rmse_after = 1.0;
  free_f.holdout.ci95_upper = 0.3;
  Proof firm;
  firm.holdout.rmse_after = 1.19;
  EXPECT_TRUE(tells_a_gap(named, free_f, firm, {}));
  EXPECT_FALSE(tells_a_gap(Selection{}, free_f, firm, {})) << "no gap is named";
  firm.holdout.rmse_after = 1.21;
  EXPECT_FALSE(tells_a_gap(named, free_f, firm, {})) << "it predicts worse";
}

// The half that a free f took of the gap is the gap's beside a firm one.
TEST(GapInSpring, IsFittedBesideEitherSpring) {
  MountedGear gear;
  gear.friction = 0.0;
  gear.half_gap = 4e-3;
  const Frame frame = *frame_of(gear);
  const auto row = std::ranges::find(causes(), std::string_view("backlash"), &CauseRow::id);
  Selection s = with_free_f(gear);
  EXPECT_FALSE(has_shared_gap(frame, s)) << "no gap is named";
  Accepted gap;
  gap.trial.cause = {&*row, &row->forms.front(), {0.5 * gear.half_gap}};
  const auto fit = extended(frame, s.final, gap.trial.cause, 0);
  ASSERT_TRUE(fit) << fit.error().message();
  s.final.fit = *fit;
  s.accepted = {gap};
  EXPECT_TRUE(may_hide_a_gap(frame, s, {})) << "f is flat in its middle, the gap named or not";
  EXPECT_TRUE(has_shared_gap(frame, s));
  const auto firm = with_other_spring(frame, s);
  ASSERT_TRUE(firm) << firm.error().message();
  EXPECT_TRUE(firm->frame.firm_spring);
  EXPECT_NEAR(firm->findings.fit.model.causes.front().shape.front(), gear.half_gap,
              0.01 * gear.half_gap);
}

// Beside hysteresis that no sum of a few stops follows exactly, a free f takes two thirds of the
// gap; a firm one predicts what is held out as well, to its 95 %.
TEST(GapInSpring, IsThatOfAFirmSpringWhereThatPredictsAsWell) {
  MountedGear gear;
  gear.half_gap = 3e-3;
  const Diagnosis d = diagnosed(gear.recordings());
  const auto gap = std::ranges::find(d.causes, "backlash", &Cause::effect);
  ASSERT_NE(gap, d.causes.end()) << d.says;
  const CauseParameter& width = gap->parameters.front();
  EXPECT_EQ(width.name, "half_gap");
  EXPECT_NEAR(width.value, gear.half_gap, 0.1 * gear.half_gap);
  EXPECT_LT(width.ci95_lower, 0.9 * width.value) << "what the hysteresis may have of it is inside";
}

TEST(GapInSpring, MayStandBehindACause) {
  const auto of = [](std::string_view id) {
    Trial trial;
    const auto row = std::ranges::find(causes(), id, &CauseRow::id);
    trial.cause = {&*row, &row->forms.front(), {}};
    return trial;
  };
  Selection other;
  other.accepted.resize(1);
  other.accepted.front().trial = of("viscoelastic_creep");
  EXPECT_FALSE(has_a_gap(other));
  other.accepted.front().rivals = {of("backlash")};
  EXPECT_TRUE(has_a_gap(other)) << "it may take its place";
  Selection named;
  named.accepted.resize(1);
  named.accepted.front().trial = of("backlash");
  EXPECT_TRUE(has_a_gap(named));
}

}  // namespace
}  // namespace flexspline::studies
