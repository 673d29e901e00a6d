// A servo's motor that crosses a gap as its load's torque changes sign: the column of backlash.
#include <cmath>
#include <stdexcept>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>
#include <Eigen/Dense>

#include "diagnosis/model/cause.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

constexpr double kInertia = 6e-4;  // kg m^2

const CauseForm& form_of(const Frame& frame) {
  for (const CauseRow& row : causes()) {
    if (row.id == "backlash") return *forms_on(row, frame).front();
  }
  throw std::logic_error("no backlash");
}

Frame servo(double sample, double duration) {
  Frame frame;
  frame.rig = Rig::servo;
  frame.ratio = 50.0;
  frame.motor_inertia = kInertia;
  frame.equations = {Equation::motor};
  const auto rows = static_cast<Index>(duration / sample);
  frame.time = sample * ArrayXd::LinSpaced(rows, 0.0, static_cast<double>(rows - 1));
  frame.torque = 30.0 * (2.0 * frame.time + 1.0).sin();
  frame.interval = sample;
  frame.segments = {{"swing", 0, rows}};
  return frame;
}

ArrayXd integral(const ArrayXd& x, double step) {
  ArrayXd sum(x.size());
  double total = 0.0;
  for (Index i = 0; i < x.size(); ++i) sum[i] = total += step * x[i];
  return sum;
}

// Twice integrated, what the torque accelerates is the motor's step to and fro.
TEST(CrossedGap, MovesTheMotorByItsJump) {
  const double sample = 1e-3;
  const Frame frame = servo(sample, 4.0);
  const std::vector<double> shape = {0.01};
  const ArrayXd column = form_of(frame).columns(Equation::motor, frame, {}, shape).front();
  const ArrayXd angle = integral(integral(column / kInertia, sample), sample);
  for (Index r = 0; r < frame.time.size(); ++r) {
    const double turn = 2.0 * frame.time[r] + 1.0;
    if (std::abs(std::sin(turn)) < 0.15) continue;  // in the gap: eight crossing times
    EXPECT_NEAR(angle[r], std::sin(turn) > 0.0 ? 0.0 : -1.0, 0.01) << frame.time[r];
  }
}

TEST(CrossedGap, IsSoughtWhereTheMotorsInertiaIsKnown) {
  Frame frame = servo(0.01, 4.0);
  EXPECT_EQ(form_of(frame).terms(frame).front().name, "jump");
  frame.motor_inertia = 0.0;
  for (const CauseRow& row : causes()) {
    if (row.id == "backlash") EXPECT_TRUE(forms_on(row, frame).empty());
  }
}

}  // namespace
}  // namespace flexspline::studies
