// Steps of an ablation: read from the lock, and ratios of errors that can be told by hand.
#include "ablation.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace flexspline::reports {
namespace {

TEST(Ablation, IsReadFromTheLock) {
  const AblationPlan plan = parse_ablation(
      "[study]\n[[study.contrast]]\nid = \"s\"\ntitle = \"t\"\nfrom = \"a\"\nto = \"b\"\n"
      "[[study.input]]\nid = \"plain\"\n[[study.input]]\nid = \"noisy\"\n"
      "bench = { angle_noise = 0.02, torque_noise_white = 0.001 }\n");
  ASSERT_EQ(plan.contrasts.size(), 1U);
  EXPECT_EQ(plan.contrasts[0].to, "b");
  ASSERT_EQ(plan.noise.size(), 1U);
  EXPECT_DOUBLE_EQ(plan.noise.at("noisy").angle, 2.0);
  EXPECT_DOUBLE_EQ(plan.noise.at("noisy").torque, 0.1);
  EXPECT_TRUE(parse_ablation("no toml [").contrasts.empty());
}

Case case_of(std::string estimator, long replicate, double g_inverse, std::vector<double> errors) {
  Case item;
  item.input = "one";
  item.estimator = std::move(estimator);
  item.method = "static_regression";
  item.replicate = replicate;
  item.train = {"trained"};
  item.function_errors_percent["g_inverse"] = g_inverse;
  for (std::size_t k = 0; k < errors.size(); ++k) {
    CaseRecording recording;
    recording.id = std::to_string(k);
    recording.rmse_percent = errors[k];
    item.recordings.push_back(recording);
  }
  return item;
}

// Two replicates: g^-1 by 6/2 and 9/1, torque by 4/2 and 8/2; the third recording lies outside the
// range of the second estimator and does not count.
TEST(Ablation, GainsAreMediansOverReplicatesWithinBothRanges) {
  Artefacts artefacts;
  Input input;
  input.id = input.title = "one";
  artefacts.inputs = {input};
  artefacts.cases = {case_of("a", 0, 6.0, {4.0, 4.0, 900.0}), case_of("b", 0, 2.0, {2.0, 2.0, 1.0}),
                     case_of("a", 1, 9.0, {8.0, 8.0, 900.0}),
                     case_of("b", 1, 1.0, {2.0, 2.0, 1.0})};
  for (Case& item : artefacts.cases) {
    if (item.estimator == "b") item.recordings[2].outside_domain = true;
  }
  const StudyView view(std::move(artefacts));
  const auto gains = gains_of(view, "a", "b");
  ASSERT_EQ(gains.size(), 1U);
  EXPECT_DOUBLE_EQ(gains[0].g_inverse, 6.0);
  EXPECT_DOUBLE_EQ(gains[0].torque, 3.0);
  const Spread3 spread = spread_of(gains, &Gain::torque);
  EXPECT_DOUBLE_EQ(spread.least, 3.0);
  EXPECT_DOUBLE_EQ(spread.most, 3.0);
  EXPECT_TRUE(gains_of(view, "a", "absent").empty());
}

}  // namespace
}  // namespace flexspline::reports
