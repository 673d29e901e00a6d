// What is in no catalogue of effects: in the model, never a name.
#include <algorithm>
#include <map>
#include <random>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "diagnosis/model/cause.hpp"
#include "diagnosis_checks.hpp"
#include "flexspline/core/effect.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;

const CauseForm& form_of(std::string_view id) {
  const auto rows = outside_causes();
  return std::ranges::find(rows, id, &CauseRow::id)->forms.front();
}

Columns columns_of(const CauseForm& form, Equation equation, const Frame& frame,
                   const std::vector<double>& shape = {}) {
  Reference reference;
  reference.elastic = frame.smooth_torque;
  reference.friction = ArrayXd::Zero(frame.rows());
  return form.columns(equation, frame, reference, shape);
}

TEST(OutsideCauses, AreNoEffectsAndStandInNoModelFile) {
  ASSERT_FALSE(outside_causes().empty());
  for (const CauseRow& row : outside_causes()) {
    EXPECT_FALSE(row.outside.empty()) << row.id;
    EXPECT_FALSE(find_effect(row.id)) << row.id;
    for (const CauseForm& form : row.forms) {
      EXPECT_EQ(form.counterpart, nullptr) << row.id;
      EXPECT_FALSE(form.no_counterpart.empty()) << row.id;
    }
  }
}

// J theta_l'' and f(phi) are read with the same error; the motor's equation takes the reading off
// over the ratio.
TEST(OutsideCauses, OfATorqueSensorAreTheSameReadingInEveryEquation) {
  const Frame frame = closed_form_frame();
  const std::map<std::string_view, std::vector<double>> shapes = {
      {"torque_sensor_memory", {}},
      {"torque_sensor_curvature", {}},
      {"torque_resonance", {8.0, 0.1}}};
  for (const auto& [id, shape] : shapes) {
    const CauseForm& form = form_of(id);
    const auto torsion = columns_of(form, Equation::torsion, frame, shape);
    const auto load = columns_of(form, Equation::load, frame, shape);
    const auto motor = columns_of(form, Equation::motor, frame, shape);
    for (std::size_t k = 0; k < torsion.size(); ++k) {
      EXPECT_GT(torsion[k].abs().maxCoeff(), 0.0) << id;
      EXPECT_TRUE((torsion[k] == load[k]).all()) << id;
      EXPECT_LT((motor[k] * frame.ratio + torsion[k]).abs().maxCoeff(), 1e-12) << id;
    }
  }
}

// The stop operator of a torque that reverses within its reach is that torque less where it began;
// beyond its reach it holds no more than that.
TEST(OutsideCauses, AMemoryHoldsBackAsMuchAsItsReach) {
  const Frame frame = closed_form_frame();
  const CauseForm& form = form_of("torque_sensor_memory");
  const auto terms = form.terms(frame);
  const auto columns = columns_of(form, Equation::load, frame);
  ASSERT_EQ(columns.size(), terms.size());
  for (std::size_t k = 0; k < columns.size(); ++k) {
    EXPECT_NEAR(columns[k].abs().maxCoeff(), terms[k].grid_value, 1e-9) << terms[k].name;
  }
}

// Of a torque that takes every value alike neither has a part of a gain; nothing is read where
// nothing pulls.
TEST(OutsideCauses, ACurveHasNoPartOfAGain) {
  Frame frame = closed_form_frame(4001 * 2);
  frame.told_torque = ArrayXd::LinSpaced(8002, -40.0, 40.0);
  for (const ArrayXd& column :
       columns_of(form_of("torque_sensor_curvature"), Equation::load, frame)) {
    EXPECT_NEAR((column * frame.told_torque).mean() / 40.0, 0.0, 0.02);
    EXPECT_NEAR(column.abs().maxCoeff(), 40.0, 1e-9);
    EXPECT_NEAR(column[4000], 0.0, 0.01) << "at no torque";
  }
}

// Noise of a sensor that hears nothing above its own band is as smooth as what it measures. A
// polynomial of both has the noise in its slope, and takes it off where it is -1.
TEST(OutsideCauses, ACurveTakesNothingOfTheNoise) {
  Frame frame = closed_form_frame();
  frame.torque = frame.told_torque + 0.5 * normal(frame.rows(), 11);
  frame.smooth_torque = frame.torque;
  const ArrayXd noise = frame.torque - frame.told_torque;
  for (const ArrayXd& column :
       columns_of(form_of("torque_sensor_curvature"), Equation::load, frame)) {
    const double along = (column * noise).mean() / std::sqrt(column.square().mean());
    EXPECT_LT(std::abs(along), 4.0 * 0.5 / std::sqrt(static_cast<double>(frame.rows())));
  }
}

// Nothing at rest, half at the half rate, all of it far beyond; of the spring's torque, so that it
// pulls as the spring does, whichever way the motion goes.
TEST(OutsideCauses, AStiffnessOfTheRateGoesWithItsSquareAndSaturates) {
  Frame frame = closed_form_frame();
  const CauseForm& form = form_of("rate_dependent_stiffness");
  const auto shapes = form.shapes(frame);
  ASSERT_EQ(shapes.size(), 1U);
  const double half = std::sqrt(shapes[0].lower * shapes[0].upper);
  Reference reference;
  reference.elastic = ArrayXd::Constant(frame.rows(), -3.0);
  for (const auto& [rate, share] :
       {std::pair{0.0, 0.0}, {half, 0.5}, {-half, 0.5}, {7.0 * half, 0.98}}) {
    frame.torsion_rate = ArrayXd::Constant(frame.rows(), rate);
    const auto columns = form.columns(Equation::torsion, frame, reference, std::vector{half});
    ASSERT_EQ(columns.size(), 1U);
    EXPECT_NEAR(columns[0].maxCoeff(), -3.0 * share, 1e-12) << rate;
    EXPECT_NEAR(columns[0].minCoeff(), -3.0 * share, 1e-12) << rate;
  }
}

/// What was named once, or called a wind-up of half the torque.
struct OutsideCase {
  data::BenchKind kind;
  std::uint64_t seed;
  const char* hidden;
  double size;
  const char* words;
};

TEST(OutsideCauses, AreUnexplainedAndInTheModel) {
  for (const OutsideCase& one : {
           OutsideCase{Rig::free, 51, "unknown:sensor_play", 0.08, "stays behind at reversals"},
           OutsideCase{Rig::locked, 51, "unknown:sensor_quadratic", 0.09, "is no line"},
           OutsideCase{{Rig::specimen, true}, 4, "unknown:dry_patch", 0.06, "along the travel"},
           OutsideCase{Rig::specimen, 51, "unknown:fixture_resonance", 0.08, "that rings"},
       }) {
    const auto hidden = drawn_case(one.kind, one.seed, {{one.hidden, one.size}});
    const Diagnosis d = diagnosed(hidden.recordings);
    EXPECT_THAT(names(d), testing::IsEmpty()) << one.hidden;
    EXPECT_EQ(d.verdict, Verdict::unexplained) << one.hidden << ": " << d.says;
    EXPECT_THAT(d.says, testing::HasSubstr("outside the catalogue")) << one.hidden;
    EXPECT_THAT(d.says, testing::HasSubstr(one.words)) << one.hidden;
    EXPECT_LT(d.holdout.ratio, 0.8) << one.hidden << ": it is in the model";
  }
}

// Nor is a motion proposed that tells a name from what has none.
TEST(OutsideCauses, AreNothingThatANameIsConfusedWith) {
  const auto hidden = drawn_case(Rig::locked, 5, {{"presliding_hysteresis", 0.06}});
  const Diagnosis d = diagnosed(hidden.recordings);
  ASSERT_FALSE(d.causes.empty()) << d.says;
  ASSERT_FALSE(d.experiments.empty());
  const auto is_outside = [](std::string_view id) {
    return std::ranges::count(outside_causes(), id, &CauseRow::id) > 0;
  };
  EXPECT_TRUE(std::ranges::any_of(d.tried, is_outside, &TriedCandidate::effect));
  EXPECT_TRUE(std::ranges::none_of(d.confusable, is_outside, &Confusable::effect));
  for (const NextExperiment& next : d.experiments) {
    EXPECT_TRUE(std::ranges::none_of(next.separates, is_outside)) << next.says;
  }
}

// A spring that relaxes is stiffer in motion, too, and was named for it.
TEST(OutsideCauses, ASpringThatIsStifferInMotionDoesNotCreep) {
  for (const std::uint64_t seed : {1, 3, 7}) {
    const auto hidden = drawn_case(Rig::locked, seed, {{"unknown:speed_stiffness", 0.06}});
    const Diagnosis d = diagnosed(hidden.recordings);
    EXPECT_TRUE(d.causes.empty()) << seed << " " << names(d).front();
    EXPECT_EQ(d.verdict, Verdict::unexplained) << seed << d.says;
  }
}

}  // namespace
}  // namespace flexspline::studies
