#include "diagnosis_engine.hpp"

#include <fmt/format.h>

#include "quantity_text.hpp"

namespace flexspline::app {
namespace {

constexpr double kLeastInterest = 1e-4;
constexpr double kMostInterest = 0.5;

Result<double> interest_of(const Arguments& arguments) {
  const auto share =
      parse_quantity("--interest", arguments.text("interest", "0.8 %"), Dimension::dimensionless);
  if (share && !(*share >= kLeastInterest && *share <= kMostInterest)) {
    return failure(
        ErrorCode::usage,
        fmt::format("--interest is {:g} %, which is not from 0.01 to 50 %", 100.0 * *share),
        "give a share of the largest torque, --interest 0.8%");
  }
  return share;
}

}  // namespace

ArgumentInfo engine_argument() {
  return {.name = "--engine",
          .meaning =
              "what decides: rules, or evidence (one mixed model; docs/diagnosis.md); "
              "default: rules",
          .value = "NAME"};
}

ArgumentInfo interest_argument() {
  return {.name = "--interest",
          .meaning =
              "with --engine evidence: share of the largest torque below which nothing is a "
              "finding; default: 0.8 %",
          .value = "SHARE"};
}

Result<std::map<std::string, std::string>> engine_words(const Arguments& arguments) {
  const std::string name = arguments.text("engine", "rules");
  if (name != "rules" && name != "evidence") {
    return failure(ErrorCode::usage, fmt::format("--engine is '{}'", name),
                   "give rules or evidence");
  }
  if (name == "rules" && arguments.has("interest")) {
    return failure(ErrorCode::usage, "--interest is for --engine evidence",
                   "leave it out, or add --engine evidence");
  }
  const auto interest = interest_of(arguments);
  if (!interest) return tl::unexpected(interest.error());
  if (name == "rules") return std::map<std::string, std::string>{};
  return std::map<std::string, std::string>{{"engine", name},
                                            {"interest", fmt::format("{}", *interest)}};
}

Result<studies::Diagnose> engine_of(const Arguments& arguments) {
  const auto words = engine_words(arguments);
  if (!words) return tl::unexpected(words.error());
  const studies::DiagnosisSettings settings = {.holdout = arguments.texts("holdout"),
                                               .nested = !arguments.has("quick")};
  if (words->empty()) {
    return [settings](const RecordingSet& recordings, const studies::DiagnosisProgress& progress) {
      return studies::diagnose(recordings, progress, settings);
    };
  }
  if (!settings.holdout.empty()) {
    return failure(ErrorCode::usage, "--holdout is for --engine rules",
                   "leave it out: every recording is held out by the outer folds");
  }
  if (!settings.nested) {
    return failure(ErrorCode::usage, "--quick is for --engine rules",
                   "leave it out: this engine has no other proof");
  }
  return studies::diagnose_as(*words, 1);
}

}  // namespace flexspline::app
