// The baseline's columns against the functions that they stand for.
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "diagnosis/frame/baseline.hpp"
#include "diagnosis/frame/low_pass.hpp"
#include "diagnosis/model/cause.hpp"
#include "diagnosis/model/model_columns.hpp"
#include "drive_frame.hpp"
#include "flexspline/core/integrated_basis.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

TEST(BaselineColumns, OfATravellingAngleHoldAHyperbolicTangentOfEachWidth) {
  Frame frame = closed_form_frame();
  frame.travels = true;
  const auto widths = dry_widths(frame.rate_range);
  const BaselineColumns all = baseline_columns(frame, Equation::torsion, {});
  ASSERT_EQ(all.columns.cols(), all.elastic + static_cast<Index>(widths.size()) + 1);
  for (std::size_t k = 0; k < widths.size(); ++k) {
    EXPECT_DOUBLE_EQ(widths[k], 1e-3 * frame.rate_range * std::exp2(0.5 * static_cast<double>(k)));
    const ArrayXd expected = (frame.torsion_rate / widths[k]).tanh();
    const ArrayXd column = all.columns.col(all.elastic + static_cast<Index>(k));
    // Rounding: nine doublings of a tanh, each off by some units of the last place.
    EXPECT_LT((column - expected).abs().maxCoeff(), 2e-14) << widths[k];
  }
}

TEST(BaselineColumns, OfAGearAreOddIntegratedSplines) {
  Frame frame = closed_form_frame(150);  // rows that fill no whole block
  const std::vector<double> shape = {0.0, 0.0, 0.0};
  const BaselineColumns all = baseline_columns(frame, Equation::torsion, shape);
  std::vector<double> knots;
  for (Index k = 1; k <= all.elastic - 3; ++k) {
    knots.push_back(static_cast<double>(k) / static_cast<double>(all.elastic - 2));
  }
  const IntegratedBasis basis(knots);
  std::vector<double> value(basis.size());
  for (Index r = 0; r < frame.rows(); ++r) {
    const double x = frame.torsion[r] / frame.torsion_range;
    basis.values(std::abs(x), value);
    for (std::size_t k = 0; k < value.size(); ++k) {
      EXPECT_DOUBLE_EQ(all.columns(r, static_cast<Index>(k)), std::copysign(value[k], x)) << r;
    }
  }
}

struct BaselineKind {
  const char* name;
  Rig rig;
  bool travels, firm;
  double lag;  // s
};

class BaselineTorqueOf : public testing::TestWithParam<BaselineKind> {};

TEST_P(BaselineTorqueOf, IsTheColumnsTimesTheirParameters) {
  const auto& [name, rig, travels, firm, lag] = GetParam();
  Frame frame = closed_form_frame(150);
  frame.rig = rig;
  frame.travels = travels;
  frame.firm_spring = firm;
  frame.torque_lag = lag;
  frame.rate_range *= 0.8;  // some rows beyond the range of the law
  const std::vector<double> shape = {0.4, -0.7, 0.1};
  const BaselineColumns all = baseline_columns(frame, Equation::torsion, shape);
  const Eigen::VectorXd b = normal(all.columns.cols(), 5).matrix();
  const BaselineTorque torque = baseline_torque(frame, shape, b);
  const double rounding = 1e-13 * (all.columns * b).norm();
  EXPECT_GT((all.columns * b).norm(), 1.0);
  EXPECT_LT((torque.sum().matrix() - all.columns * b).norm(), rounding);
  EXPECT_LT((torque.prior - all.prior * b).norm(), 1e-13 * (all.prior * b).norm());
  const auto part = [&](Index first, Index count) {
    return ArrayXd((all.columns.middleCols(first, count) * b.segment(first, count)).array());
  };
  EXPECT_LT((torque.elastic - part(0, all.elastic)).matrix().norm(), rounding);
  EXPECT_LT((torque.dissipative - part(all.elastic, all.dissipative)).matrix().norm(), rounding);
  EXPECT_EQ(torque.offset, rig == Rig::specimen ? b[b.size() - 1] : 0.0);
}

INSTANTIATE_TEST_SUITE_P(Kinds, BaselineTorqueOf,
                         testing::Values(BaselineKind{"free", Rig::free, false, false, 0.0},
                                         BaselineKind{"firm", Rig::free, false, true, 0.0},
                                         BaselineKind{"filtered", Rig::free, false, false, 0.03},
                                         BaselineKind{"specimen", Rig::specimen, false, false, 0.0},
                                         BaselineKind{"travels", Rig::free, true, false, 0.0},
                                         BaselineKind{"both", Rig::free, true, false, 0.03}),
                         [](const auto& of) { return std::string(of.param.name); });

TEST(LowPass, FiltersColumnsTogetherAsOneByOne) {
  const Frame frame = closed_form_frame();
  const LowPass filter(frame, 0.03);
  for (const Index count : {1, 5, 13}) {
    Eigen::MatrixXd together(frame.rows(), count);
    for (Index k = 0; k < count; ++k) {
      together.col(k) = (frame.torque * (1.0 + 0.3 * static_cast<double>(k))).sin();
    }
    Eigen::MatrixXd alone = together;
    filter.apply(together);
    for (Index k = 0; k < count; ++k) filter.apply(alone.col(k));
    EXPECT_EQ(together, alone) << count;
  }
}

TEST(LowPass, IsKeptForTheTimeConstantAndTheTimesThatItIsOf) {
  Frame frame = closed_form_frame();
  frame.kept = no_baselines_yet();
  const auto first = shared_low_pass(frame, 0.03);
  EXPECT_EQ(shared_low_pass(frame, 0.03), first);
  EXPECT_NE(shared_low_pass(frame, 0.04), first);
  Frame cut = frame;  // it starts anew where a recording does
  cut.segments.pop_back();
  EXPECT_NE(shared_low_pass(cut, 0.03), first);
  Frame slower = frame;
  slower.time *= 2.0;
  EXPECT_NE(shared_low_pass(slower, 0.03), first);
  frame.kept = nullptr;
  EXPECT_NE(shared_low_pass(frame, 0.03), first);
}

}  // namespace
}  // namespace flexspline::studies
