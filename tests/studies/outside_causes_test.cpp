// What is in no catalogue of effects: in the model, never a name.
#include <algorithm>
#include <random>

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

Columns columns_of(const CauseForm& form, Equation equation, const Frame& frame) {
  Reference reference;
  reference.elastic = frame.smooth_torque;
  std::vector<double> middle;
  if (form.shapes) {
    for (const Shape& shape : form.shapes(frame))
      middle.push_back(0.5 * (shape.lower + shape.upper));
  }
  return form.columns(equation, frame, reference, middle);
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
  for (const char* id : {"torque_sensor_memory", "torque_sensor_curvature", "torque_sensor_jump"}) {
    const CauseForm& form = form_of(id);
    const auto torsion = columns_of(form, Equation::torsion, frame);
    const auto load = columns_of(form, Equation::load, frame);
    const auto motor = columns_of(form, Equation::motor, frame);
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
  frame.smooth_torque = ArrayXd::LinSpaced(8002, -40.0, 40.0);
  for (const ArrayXd& column :
       columns_of(form_of("torque_sensor_curvature"), Equation::load, frame)) {
    EXPECT_NEAR((column * frame.smooth_torque).mean() / 40.0, 0.0, 0.02);
    EXPECT_NEAR(column.abs().maxCoeff(), 40.0, 1e-9);
    EXPECT_NEAR(column[4000], 0.0, 0.01) << "at no torque";
  }
}

TEST(OutsideCauses, AJumpIsNoneBeforeItsRecordingAndWholeFromItOn) {
  const Frame frame = closed_form_frame();
  const auto columns = columns_of(form_of("torque_sensor_jump"), Equation::load, frame);
  ASSERT_EQ(columns.size(), 1U);
  EXPECT_EQ(columns[0].minCoeff(), 0.0);
  EXPECT_EQ(columns[0].maxCoeff(), 1.0);
  for (const Segment& s : frame.segments) {
    const double jumped = frame.clock[s.first] < 0.5 * frame.session ? 0.0 : 1.0;
    EXPECT_TRUE((columns[0].segment(s.first, s.count) == jumped).all()) << s.id;
  }
}

// A knock in the middle of a session, which a drift was named for.
TEST(OutsideCauses, ASensorWhoseZeroJumpsIsUnexplained) {
  auto set = drawn_case(Rig::locked, 51).recordings;
  double session = 0.0, largest = 0.0;
  for (const Recording& r : set.recordings) {
    session = std::max(session, r.start_s);
    for (double torque : r.channels.at(Quantity::transmitted_torque)) {
      largest = std::max(largest, std::abs(torque));
    }
  }
  for (Recording& r : set.recordings) {
    if (r.start_s < 0.5 * session) continue;
    for (double& torque : r.channels.at(Quantity::transmitted_torque)) torque += 0.03 * largest;
  }
  const Diagnosis d = diagnosed(set);
  EXPECT_TRUE(d.causes.empty()) << names(d).front();
  EXPECT_EQ(d.verdict, Verdict::unexplained) << d.says;
  EXPECT_NE(d.says.find("zero jumps"), std::string::npos) << d.says;
}

// Hysteresis of the sensor, which the gear's own was named for.
TEST(OutsideCauses, AFreeDrivesSensorWithPlayIsUnexplained) {
  const auto hidden = drawn_case(Rig::free, 51, {{"unknown:sensor_play", 0.08}});
  const Diagnosis d = diagnosed(hidden.recordings);
  EXPECT_TRUE(d.causes.empty()) << names(d).front();
  EXPECT_EQ(d.verdict, Verdict::unexplained) << d.says;
  EXPECT_NE(d.says.find("outside the catalogue"), std::string::npos) << d.says;
  EXPECT_LT(d.holdout.ratio, 0.5) << "it is in the model";
}

}  // namespace
}  // namespace flexspline::studies
