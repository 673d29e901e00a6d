#include "diagnosis/search/linearised.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "drive_frame.hpp"

namespace flexspline::studies {
namespace {

/// A cause at the middle of its shapes, or where a change of the motion starts.
ActiveCause cause_of(const CauseRow& row, const CauseForm& form, const Frame& frame) {
  ActiveCause cause{&row, &form, {}};
  if (form.start != nullptr) {
    cause.shape = form.start(frame);
  } else if (form.shapes != nullptr) {
    for (const Shape& s : form.shapes(frame)) {
      const double mean = s.logarithmic ? std::sqrt(s.lower * s.upper) : 0.5 * (s.lower + s.upper);
      cause.shape.push_back(s.discrete ? s.lower : mean);
    }
  }
  return cause;
}

Frame frame_with_an_effect(Rig rig) {
  const char* hidden = rig == Rig::locked ? "presliding_hysteresis" : "stribeck_friction";
  auto frame = make_frame(drawn_case(rig, 7, {{hidden, 0.06}}).recordings, 4000);
  EXPECT_TRUE(frame) << (frame ? "" : frame.error().message());
  return frame ? *std::move(frame) : Frame{};
}

class LinearisedOn : public testing::TestWithParam<Rig> {
 protected:
  const Frame frame_ = frame_with_an_effect(GetParam());
  const Findings findings_ = *fit_baseline(frame_);

  double gain_of(const Result<ModelFit>& fit) const {
    return chi_square(frame_, findings_, findings_.fit) - chi_square(frame_, findings_, *fit);
  }
};

TEST_P(LinearisedOn, GainsWhatTheWholeFitGains) {
  int compared = 0;
  for (const CauseRow& row : causes()) {
    for (const CauseForm* form : forms_on(row, frame_)) {
      const ActiveCause cause = cause_of(row, *form, frame_);
      const Linearised about(frame_, findings_,
                             linked_equations(frame_, findings_.fit.model.causes, *form));
      const auto near = about.with(cause, 12);
      ASSERT_TRUE(near) << row.id << ": " << near.error().message();
      auto whole = extended(frame_, findings_, {&row, form, near->shape}, 40);
      ASSERT_TRUE(whole) << row.id << ": " << whole.error().message();
      if (!(gain_of(whole) > 40.0)) continue;
      // A candidate that is fitted to its end at 0.6 of the best must not have been one of 0.9.
      EXPECT_GT(near->gain, 0.6 / 0.9 * gain_of(whole)) << row.id << ", " << form->equation;
      EXPECT_LT(near->gain, 0.9 / 0.6 * gain_of(whole)) << row.id << ", " << form->equation;
      ++compared;
    }
  }
  EXPECT_GE(compared, 2);
}

// Without shapes of the baseline there is nothing that a first order leaves out but what a change
// of the motion does to the baseline's columns.
TEST_P(LinearisedOn, IsExactWhereTheBaselineIsLinear) {
  int compared = 0;
  for (const CauseRow& row : causes()) {
    for (const CauseForm* form : forms_on(row, frame_)) {
      if (frame_.has(Equation::torsion) && std::ranges::count(form->at, Equation::torsion) > 0) {
        continue;
      }
      const ActiveCause cause = cause_of(row, *form, frame_);
      const Linearised about(frame_, findings_,
                             linked_equations(frame_, findings_.fit.model.causes, *form));
      const auto near = about.with(cause, 0);
      const auto whole = extended(frame_, findings_, cause, 0);
      ASSERT_TRUE(near && whole) << row.id;
      const double all = chi_square(frame_, findings_, findings_.fit);
      const double share = form->transform != nullptr ? 1e-4 : 1e-6;
      EXPECT_NEAR(near->gain, gain_of(whole), share * all) << row.id << ", " << form->equation;
      ++compared;
    }
  }
  EXPECT_GT(compared, 3);
}

INSTANTIATE_TEST_SUITE_P(Rigs, LinearisedOn, testing::Values(Rig::locked, Rig::free, Rig::servo),
                         [](const auto& one) { return std::string(name_of(one.param)); });

}  // namespace
}  // namespace flexspline::studies
