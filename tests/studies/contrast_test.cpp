// Contrasts between estimators, and inputs that the bench records in their own way.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "flexspline/studies/plan.hpp"
#include "study_file.hpp"

namespace flexspline::studies {
namespace {

using testing::AllOf;
using testing::HasSubstr;

const std::string kNoisy =
    "[[input]]\nid = \"noisy\"\ntruth = \"unity\"\nholdout = \"point\"\n"
    "bench = { angle_noise = { value = 2, unit = \"%\" } }\n";
const std::string kBench = "[bench]\ntorque_noise_white = { value = 0.5, unit = \"%\" }\n";
const std::string kContrast = "[[contrast]]\nid = \"nothing\"\nfrom = \"paper\"\nto = \"paper\"\n";

TEST(Contrast, AndAnInputsOwnBenchAreRead) {
  const ScratchFolder folder;
  const auto study = load_study(folder.write(
      "study.toml", kHead + kBench + kGrid + kInput + kNoisy + kEstimator + kContrast));
  ASSERT_TRUE(study) << study.error().message();
  ASSERT_EQ(study->contrasts.size(), 1U);
  EXPECT_EQ(study->contrasts[0].title, "nothing");
  EXPECT_DOUBLE_EQ(study->bench_of(study->inputs[0]).sensors.angle_noise, 0.0);
  EXPECT_DOUBLE_EQ(study->bench_of(study->inputs[1]).sensors.angle_noise, 0.02);
  EXPECT_DOUBLE_EQ(study->bench_of(study->inputs[1]).sensors.torque_noise_white, 0.005)
      << "what is not given is the study's";
  const auto plan = plan_study(*study, "build");
  ASSERT_TRUE(plan);
  EXPECT_NE(plan->at(0).fit_depends_on, plan->at(1).fit_depends_on);
}

TEST(Contrast, RefusesAnEstimatorThatIsNotThere) {
  const ScratchFolder folder;
  const auto study = load_study(folder.write(
      "study.toml", kHead + kGrid + kInput + kEstimator +
                        "[[contrast]]\nid = \"a\"\nfrom = \"papr\"\nto = \"paper\"\n"));
  ASSERT_FALSE(study);
  EXPECT_THAT(study.error().message(),
              AllOf(HasSubstr("names no estimator 'papr'"), HasSubstr("did you mean 'paper'?")));
}

}  // namespace
}  // namespace flexspline::studies
