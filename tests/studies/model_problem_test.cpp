// A model as a separable problem: what it leaves, by its columns and without them.
#include "diagnosis/model/model_problem.hpp"

#include <string>

#include <gtest/gtest.h>

#include "diagnosis/search/search.hpp"
#include "drive_frame.hpp"

namespace flexspline::studies {
namespace {

class ModelProblemOn : public testing::TestWithParam<Rig> {};

TEST_P(ModelProblemOn, LeavesWithoutItsColumnsWhatItLeavesByThem) {
  const Frame frame = drawn_frame(GetParam());
  const auto findings = fit_baseline(frame);
  ASSERT_TRUE(findings) << findings.error().message();
  int compared = 0;
  for (const CauseRow& row : causes()) {
    for (const CauseForm* form : forms_on(row, frame)) {
      DriveModel start = findings->fit.model;
      start.causes = {
          {&row, form, form->start != nullptr ? form->start(frame) : std::vector<double>{}}};
      if (form->start == nullptr && form->shapes != nullptr) {
        for (const Shape& s : form->shapes(frame)) start.causes[0].shape.push_back(s.lower);
      }
      ModelColumns columns(frame, findings->reference);
      const ModelProblem problem(columns, frame, findings->fit_weight, frame.equations, start);
      const auto q = estimators::starts_of(problem.shapes());
      const Eigen::VectorXd b = normal(problem.lower().size(), 9).matrix();
      const auto residuals = problem.residuals(q, b);
      const auto blocks = problem.assemble(q);
      ASSERT_EQ(residuals.size(), blocks.size());
      for (std::size_t e = 0; e < blocks.size(); ++e) {
        const Eigen::VectorXd by_columns = residual_of(blocks[e], b(blocks[e].index));
        EXPECT_LT((residuals[e] - by_columns).norm(), 1e-12 * by_columns.norm())
            << row.id << ", " << form->equation;
      }
      ++compared;
    }
  }
  EXPECT_GE(compared, 5);
}

INSTANTIATE_TEST_SUITE_P(Rigs, ModelProblemOn,
                         testing::Values(Rig::locked, Rig::free, Rig::servo, Rig::specimen),
                         [](const auto& of) { return std::string(name_of(of.param)); });

}  // namespace
}  // namespace flexspline::studies
