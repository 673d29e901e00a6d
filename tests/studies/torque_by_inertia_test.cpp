// A free drive whose torque no sensor measures: what its load's inertia takes stands for it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "diagnosis/frame/baseline.hpp"
#include "diagnosis/frame/equations_of.hpp"
#include "diagnosis/model/cause.hpp"
#include "diagnosis/model/noise.hpp"
#include "drive_frame.hpp"
#include "without_sensor.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using testing::ElementsAre;
using testing::HasSubstr;

Frame by_inertia() {
  Frame f = closed_form_frame();
  f.torque_by_inertia = true;
  f.equations = {Equation::torsion, Equation::motor};
  f.weigh_load();
  return f;
}

const CauseRow& row_of(std::string_view id) {
  return *std::ranges::find(causes(), id, &CauseRow::id);
}

Columns columns_of(const CauseForm& form, Equation equation, const Frame& f) {
  return form.columns(equation, f, Reference{}, {});
}

TEST(TorqueByInertia, IsWhatTheFrameOfSuchRecordingsHas) {
  const auto frame = make_frame(without_sensor(drawn_case(Rig::free, 3).recordings), 4000);
  ASSERT_TRUE(frame) << frame.error().message();
  EXPECT_TRUE(frame->torque_by_inertia);
  EXPECT_THAT(frame->equations, ElementsAre(Equation::torsion, Equation::motor));
  EXPECT_TRUE(frame->torque.isApprox(frame->load_inertia * frame->load_acceleration));
}

// The drag at the load and the encoder's steps part them: a few percent of this bench's torque.
TEST(TorqueByInertia, IsNearWhatASensorMeasures) {
  const RecordingSet set = drawn_case(Rig::free, 3).recordings;
  const auto with = make_frame(set, 4000);
  const auto without = make_frame(without_sensor(set), 4000);
  ASSERT_TRUE(with && without);
  const ArrayXd rows = with->rows_of(Equation::load) * without->rows_of(Equation::torsion);
  const double apart = std::sqrt(((with->torque - without->torque).square() * rows).mean());
  EXPECT_LT(apart, 0.1 * std::sqrt((with->torque.square() * rows).mean()));
}

TEST(TorqueByInertia, NeedsTheInertia) {
  RecordingSet set = without_sensor(drawn_case(Rig::free, 3).recordings);
  set.constants.erase("load_inertia_kgm2");
  const auto frame = make_frame(set, 4000);
  ASSERT_FALSE(frame);
  EXPECT_EQ(frame.error().code, ErrorCode::bad_data);
  EXPECT_THAT(frame.error().message(), HasSubstr("state load_inertia_kgm2 in [constants]"));
}

// tau = J2 theta_l'' + B2 theta_l' in the equation of the load, f + g^-1 in that of the torsion.
TEST(TorqueByInertia, LacksTheDragOfTheLoad) {
  const Frame f = by_inertia();
  const auto [columns, lower, elastic, dissipative, prior] =
      baseline_columns(f, Equation::torsion, std::vector(3, 0.0));
  const Eigen::Index last = columns.cols() - 1;
  EXPECT_TRUE(columns.col(last).isApprox(-f.load_speed.matrix()));
  Eigen::VectorXd b = Eigen::VectorXd::Ones(columns.cols());
  b[last] = 0.7;
  EXPECT_TRUE(baseline_torque(f, std::vector(3, 0.0), b).sum().matrix().isApprox(columns * b));
}

// Of what pulls at the load the torsion's equation lacks all, and the motor's a share of 1/N.
TEST(TorqueByInertia, MovesWhatActsAtTheLoad) {
  const Frame f = by_inertia();
  const Frame with = closed_form_frame();
  const auto forms = forms_on(row_of("gravity_load"), f);
  const auto usual = forms_on(row_of("gravity_load"), with);
  ASSERT_EQ(forms.size(), 1U);
  ASSERT_EQ(usual.size(), 1U);
  EXPECT_THAT(forms[0]->at, ElementsAre(Equation::torsion, Equation::motor));
  EXPECT_THAT(usual[0]->at, ElementsAre(Equation::load));
  const Columns at_load = columns_of(*usual[0], Equation::load, f);
  const Columns across = columns_of(*forms[0], Equation::torsion, f);
  const Columns at_motor = columns_of(*forms[0], Equation::motor, f);
  ASSERT_EQ(across.size(), at_load.size());
  for (std::size_t k = 0; k < at_load.size(); ++k) {
    EXPECT_TRUE(across[k].isApprox(-at_load[k]));
    EXPECT_TRUE(at_motor[k].isApprox(at_load[k] / f.ratio));
  }
}

// A wrong inertia rescales f and g^-1: in their equation it would explain the torque by itself.
TEST(TorqueByInertia, HasTheLoadsInertiaAtTheMotorAlone) {
  const Frame f = by_inertia();
  for (const CauseForm* form : forms_on(row_of("inertia_torque"), f)) {
    EXPECT_THAT(form->at, ElementsAre(Equation::motor)) << form->equation;
  }
}

TEST(TorqueByInertia, HasNothingThatASensorDoes) {
  const Frame f = by_inertia();
  for (const char* id :
       {"torque_sensor_offset", "torque_sensor_gain", "torque_sensor_drift", "sensor_crosstalk"}) {
    EXPECT_TRUE(forms_on(row_of(id), f).empty()) << id;
    EXPECT_FALSE(forms_on(row_of(id), closed_form_frame()).empty()) << id;
  }
  EXPECT_FALSE(forms_on(row_of("backlash"), f).empty());
}

TEST(TorqueByInertia, IsNoSurerThanTheAcceleration) {
  Frame f = by_inertia();
  f.load_acceleration_error = ArrayXd::Constant(f.rows(), 0.3);
  const ArrayXd small = 1e-3 * normal(f.rows(), 5);
  for (const double level : noise_without(f, Equation::torsion, small, {}, {}).level) {
    EXPECT_NEAR(level, 0.3 * f.load_inertia, 1e-9);
  }
  for (const double level : noise_without(f, Equation::motor, small, {}, {}).level) {
    EXPECT_NEAR(level, 1e-3, 2e-4);
  }
}

}  // namespace
}  // namespace flexspline::studies
