// A model as a separable problem: what it leaves, by its columns and without them, and as a shape
// moves.
#include "diagnosis/model/model_problem.hpp"

#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "diagnosis/search/search.hpp"
#include "drive_frame.hpp"

namespace flexspline::studies {
namespace {

/// A model of the baseline and one cause on drawn recordings, at each form that they can have.
class ModelProblemOn : public testing::TestWithParam<Rig> {
 protected:
  void SetUp() override {
    auto fitted = fit_baseline(frame_);
    ASSERT_TRUE(fitted) << fitted.error().message();
    findings_ = *std::move(fitted);
  }

  template <class Compare>
  void with_each_form(const Compare& compare) {
    int compared = 0;
    for (const CauseRow& row : causes()) {
      for (const CauseForm* form : forms_on(row, frame_)) {
        DriveModel start = findings_.fit.model;
        start.causes = {
            {&row, form, form->start != nullptr ? form->start(frame_) : std::vector<double>{}}};
        if (form->start == nullptr && form->shapes != nullptr) {
          for (const Shape& s : form->shapes(frame_)) start.causes[0].shape.push_back(s.lower);
        }
        SCOPED_TRACE(fmt::format("{}, {}", row.id, form->equation));
        ModelColumns columns(frame_, findings_.reference);
        compare(ModelProblem(columns, frame_, findings_.fit_weight, frame_.equations, start));
        ++compared;
      }
    }
    EXPECT_GE(compared, 5);
  }

  const Frame frame_ = drawn_frame(GetParam());
  Findings findings_;
};

TEST_P(ModelProblemOn, LeavesWithoutItsColumnsWhatItLeavesByThem) {
  with_each_form([](const ModelProblem& problem) {
    const auto q = estimators::starts_of(problem.shapes());
    const Eigen::VectorXd b = normal(problem.lower().size(), 9).matrix();
    const auto residuals = problem.residuals(q, b);
    const auto blocks = problem.assemble(q);
    ASSERT_EQ(residuals.size(), blocks.size());
    for (std::size_t e = 0; e < blocks.size(); ++e) {
      const Eigen::VectorXd by_columns = residual_of(blocks[e], b(blocks[e].index));
      EXPECT_LT((residuals[e] - by_columns).norm(), 1e-12 * by_columns.norm());
    }
  });
}

TEST_P(ModelProblemOn, ChangesWithAShapeByWhatItsResidualsChange) {
  int moved = 0;
  with_each_form([&](const ModelProblem& problem) {
    estimators::SeparableFit fit;
    fit.q = estimators::starts_of(problem.shapes());
    fit.b = normal(problem.lower().size(), 9).matrix();
    fit.residual = problem.residuals(fit.q, fit.b);
    for (std::size_t i = 0; i < fit.q.size(); ++i) {
      const double step = 50.0 * estimators::difference_step(problem.shapes()[i], fit.q[i]);
      if (step == 0.0) continue;
      auto q = fit.q;
      q[i] += step;
      const auto after = problem.residuals(q, fit.b);
      const auto changes = problem.changes(fit, i, step);
      ASSERT_EQ(changes.size(), after.size());
      for (std::size_t e = 0; e < after.size(); ++e) {
        Eigen::VectorXd apart = after[e] - fit.residual[e];
        if (changes[e].size() > 0) apart -= changes[e], ++moved;
        EXPECT_LT(apart.norm(), 1e-11 * after[e].norm()) << "shape " << i << ", equation " << e;
      }
    }
  });
  EXPECT_GT(moved, 5);
}

INSTANTIATE_TEST_SUITE_P(Rigs, ModelProblemOn,
                         testing::Values(Rig::locked, Rig::free, Rig::servo, Rig::specimen),
                         [](const auto& of) { return std::string(name_of(of.param)); });

}  // namespace
}  // namespace flexspline::studies
