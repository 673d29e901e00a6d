// Recordings of others, diagnosed: the two tables of docs/diagnosis.md, computed again. The
// recordings are no part of the project; the tests skip where they are absent.
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <numbers>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "claims/claims.hpp"
#include "diagnosis_checks.hpp"
#include "flexspline/data/dataset.hpp"
#include "source_dir.hpp"

namespace flexspline::studies {
namespace {

constexpr const char* kPage = "docs/diagnosis.md";

struct Row {
  std::string claim;  ///< of its row in the page
  std::string set;
  std::vector<std::string> holdout{};  ///< taken away before the search
  std::string told{};                  ///< claim of a sentence that tells parameters
  std::vector<std::string> parameters{};
};

void PrintTo(const Row& row, std::ostream* out) { *out << row.claim; }

/// To three significant digits, without an exponent.
std::string printed(double value) {
  const int decimals = 2 - static_cast<int>(std::floor(std::log10(std::abs(value))));
  const double unit = std::pow(10.0, -decimals);
  return fmt::format("{:.{}f}", unit * std::round(value / unit), std::max(decimals, 0));
}

std::string causes_of(const Diagnosis& d, bool with_ratios) {
  std::string text;
  for (const Cause& cause : d.causes) {
    text += fmt::format("{}`{}`", text.empty() ? "" : ", ", cause.effect);
    if (!with_ratios) continue;
    text += fmt::format(" ({:.2f}", cause.evidence.holdout_rmse_ratio);
    text += std::isnan(cause.stability) ? ")" : fmt::format(", {:.0f} %)", 100.0 * cause.stability);
  }
  return text.empty() ? "nothing" : text;
}

class RealRecordings : public testing::TestWithParam<Row> {
 protected:
  Diagnosis diagnosis() {
    const auto set = data::load_dataset(folder() / GetParam().set);
    EXPECT_TRUE(set) << set.error().message();
    if (!set) return {};
    auto d = diagnose(*set, {}, {.holdout = GetParam().holdout});
    EXPECT_TRUE(d) << d.error().message();
    return d ? *std::move(d) : Diagnosis{};
  }
  void SetUp() override {
    if (!std::filesystem::exists(folder() / "cycloidal-onyx" / "dataset.toml")) {
      GTEST_SKIP() << "the real recordings are not at " << folder().string();
    }
  }

 private:
  static std::filesystem::path folder() {
    const char* given = std::getenv("FLEXSPLINE_SHARED");
    const auto beside = std::filesystem::path(FLEXSPLINE_SOURCE_DIR) / ".." / "shared";
    return (given != nullptr ? std::filesystem::path(given) : beside) / "recordings";
  }
};

using Diagnosed = RealRecordings;
using TakenAway = RealRecordings;

std::string name_of_test(const testing::TestParamInfo<Row>& info) {
  std::string name = info.param.claim;
  std::erase(name, '-');
  return name;
}

/// "backlash half_gap" in SI, but angles in degrees.
claims::Number number_of(const Diagnosis& d, const std::string& name) {
  for (const Cause& cause : d.causes) {
    for (const CauseParameter& one : cause.parameters) {
      if (cause.effect + " " + one.name != name) continue;
      return {name, std::abs(one.value) * (one.unit == "rad" ? 180.0 / std::numbers::pi : 1.0)};
    }
  }
  ADD_FAILURE() << "there is no " << name;
  return {name, 0.0};
}

TEST_P(Diagnosed, AsThePageSays) {
  const Diagnosis d = diagnosis();
  ASSERT_TRUE(d.cross_validated);
  claims::expect_text(
      kPage, GetParam().claim,
      fmt::format("`{}` | {} | {} | {} | {} | {}", name_of(d.verdict), causes_of(d, true),
                  printed(d.holdout.rmse_before), printed(d.cross_validated->rmse_after),
                  printed(d.holdout.rmse_after), printed(d.holdout.noise_floor)));
  std::vector<claims::Number> numbers;
  for (const std::string& name : GetParam().parameters) numbers.push_back(number_of(d, name));
  if (!numbers.empty()) claims::expect(kPage, GetParam().told, numbers);
}

const std::vector<Row> kDiagnosed = {
    {"real-gear", "cycloidal-onyx"},
    {"real-preload-1", "cycloidal-onyx-split-p1"},
    {"real-preload-6", "cycloidal-onyx-split-p6"},
    {"real-preload-12", "cycloidal-onyx-split-p12"},
    {"real-damper", "band-damper"},
    {"real-joint-1",
     "iiwa-j1",
     {},
     "joint-1-delay",
     {"sensor_delay delay", "sensor_delay time_constant", "inertia_torque inertia"}},
    {"real-joint-4", "iiwa-j4"},
    {"real-joint-6", "iiwa-j6"},
    {"real-servo", "xl330-pendulum"}};

INSTANTIATE_TEST_SUITE_P(RealRecordings, Diagnosed, testing::ValuesIn(kDiagnosed), name_of_test);

TEST_P(TakenAway, LeavesWhatThePageSays) {
  const Diagnosis d = diagnosis();
  EXPECT_TRUE(d.holdout.nested);
  claims::expect_text(kPage, GetParam().claim,
                      fmt::format("{} | {} | {}", causes_of(d, false),
                                  printed(d.holdout.rmse_before), printed(d.holdout.rmse_after)));
}

INSTANTIATE_TEST_SUITE_P(RealRecordings, TakenAway,
                         testing::Values(Row{
                             "strict-joint-1", "iiwa-j1", {"j1-vel_p25", "j1-vel_p5"}}),
                         name_of_test);

}  // namespace
}  // namespace flexspline::studies
