// What the README says of the paper's study, computed again.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "claims/claims.hpp"
#include "flexspline/data/artefact.hpp"
#include "flexspline/studies/run.hpp"
#include "source_dir.hpp"
#include "stored.hpp"
#include "study_file.hpp"

namespace flexspline::studies {
namespace {

using nlohmann::ordered_json;

const std::vector<std::string> kTruths = {"table_i",      "unity",        "h_even",    "h_even_odd",
                                          "g_asymmetric", "f_asymmetric", "harmonics", "sensor_lag",
                                          "inertia",      "all"};
const std::vector<std::string> kColumns = {"paper", "paper_measured", "paper_pooled", "static",
                                           "trajectory"};

class FirstStudy : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<ScratchFolder>();
    const auto study = load_study(std::string(FLEXSPLINE_SOURCE_DIR) + "/studies/paper.toml");
    ASSERT_TRUE(study) << study.error().message();
    const auto plan = plan_study(*study, "test");
    ASSERT_TRUE(plan) << plan.error().message();
    RunSettings settings;
    settings.folder = folder_->path();
    settings.jobs = 2;
    settings.build_id = "test";
    const auto summary = run_study(*plan, settings);
    ASSERT_TRUE(summary) << summary.error().message();
    EXPECT_TRUE(summary->failed.empty());
  }
  static void TearDownTestSuite() { folder_.reset(); }

  static ordered_json of(const std::string& input, const std::string& estimator) {
    return stored_artefact(folder_->path(), input + "--" + estimator + "--r0");
  }
  static double damping_error(const ordered_json& one) {
    return one.at("function_errors_percent").at("g_inverse");
  }
  static double torque_error(const ordered_json& one, double amplitude, double frequency) {
    for (const auto& recording : one.at("recordings")) {
      const bool here = std::abs(recording.at("amplitude").get<double>() - amplitude) < 1e-6 &&
                        std::abs(recording.at("frequency_hz").get<double>() - frequency) < 1e-9;
      if (here && recording.at("role") == "holdout")
        return recording.at("rmse_true_percent_of_peak");
    }
    return std::nan("");
  }
  /// Median over the held-out recordings within the range of both.
  static double within(const ordered_json& one, const ordered_json& other) {
    std::vector<double> errors;
    for (std::size_t k = 0; k < one.at("recordings").size(); ++k) {
      const auto& recording = one.at("recordings")[k];
      const auto& twin = other.at("recordings")[k];
      if (recording.at("role") != "holdout") continue;
      if (recording.at("outside_domain") || twin.at("outside_domain")) continue;
      errors.push_back(recording.at("rmse_true_percent_of_peak"));
    }
    std::ranges::sort(errors);
    const std::size_t half = errors.size() / 2;
    return errors.size() % 2 == 1 ? errors[half] : 0.5 * (errors[half - 1] + errors[half]);
  }

  static std::unique_ptr<ScratchFolder> folder_;
};

std::unique_ptr<ScratchFolder> FirstStudy::folder_;

TEST_F(FirstStudy, HasTheErrorsThatTheReadmePrints) {
  std::vector<claims::Number> numbers;
  for (const std::string& truth : kTruths) {
    if (truth == "unity") numbers.push_back({"h = 1", 1.0});
    for (const std::string& estimator : kColumns) {
      const ordered_json one = of(truth, estimator);
      numbers.push_back({truth + ", g^-1, " + estimator, damping_error(one)});
      numbers.push_back({truth + ", torque, " + estimator, torque_error(one, 0.08, 0.005)});
    }
  }
  claims::expect("README.md", "first-study", numbers);
}

TEST_F(FirstStudy, GainsWhatTheReadmeSaysBySimulating) {
  double least = std::numeric_limits<double>::infinity();
  double most = 0.0;
  for (const std::string& truth : kTruths) {
    const ordered_json before = of(truth, "static");
    const ordered_json after = of(truth, "trajectory");
    const double gain = within(before, after) / within(after, before);
    least = std::min(least, gain);
    most = std::max(most, gain);
  }
  claims::expect("README.md", "simulation", {{"least", least}, {"most", most}});
}

TEST_F(FirstStudy, MissesARateIndependentTruthAsTheReadmeSays) {
  const ordered_json one = of("rate_independent", "paper");
  claims::expect("README.md", "rate-independent",
                 {{"half the frequency", torque_error(one, 0.2, 0.0025)},
                  {"0.4 of the amplitude", torque_error(one, 0.08, 0.005)},
                  {"the amplitude's share", 0.08 / 0.2}});
}

}  // namespace
}  // namespace flexspline::studies
