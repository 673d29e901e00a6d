#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "flexspline/reports/artefacts.hpp"
#include "flexspline/reports/section.hpp"

namespace flexspline::reports {

/// A share with its 95 % interval.
struct ShownRate {
  double count = 0.0;
  double of = 0.0;
  double rate = kAbsent;
  double lower = kAbsent;
  double upper = kAbsent;
};

/// Scores under the names of docs/trials.md.
struct ShownScores {
  std::map<std::string, double> numbers;
  std::map<std::string, ShownRate> rates;

  double number(const std::string& name) const;
  ShownRate rate(const std::string& name) const;
};

/// Single effects within a range of sizes, or of traces.
struct ShownDetectionBin {
  double from = kAbsent;
  double to = kAbsent;  ///< absent: no upper end
  double cases = 0.0;
  double detected = 0.0;
  double first_right = 0.0;
  double exact = 0.0;
};

struct ShownEffectScore {
  std::string rig, effect;
  double cases = 0.0;
  double failed = 0.0;
  double first_right = 0.0;
  double exact = 0.0;
  double coordinate = 0.0;
  double coordinate_right = 0.0;
  double after_over_noise = kAbsent;
};

/// Names given with a probability in a range, and how many were right.
struct ShownReliabilityBin {
  double from = kAbsent;
  double to = kAbsent;
  double mean_probability = kAbsent;
  ShownRate right;
};

/// Recordings by others with an effect spliced in, or changed.
struct ShownSplices {
  ShownRate found_small, found_large, same_verdict;
  double names_shared = kAbsent;
};

/// Hold-out error over the noise of the cases with one verdict.
struct ShownVerdictError {
  std::string verdict;
  double cases = 0.0;
  double median = kAbsent;
};

struct ShownConfusion {
  std::string truth, named;
  double count = 0.0;
};

struct ShownTrialCase {
  std::string key, rig, verdict, failure;
  std::vector<std::string> effects, named;
  std::vector<double> size, trace;
  bool right = false;
  double after_over_noise = kAbsent;
  double seconds = kAbsent;
};

struct ShownTwin {
  std::string rig, effect, twin, reason;
};

/// flexspline-trial-result/1.
struct TrialView {
  std::string name, title, build_id;
  std::string design;  ///< as it stands in the artefact
  ShownScores scores;
  ShownScores scores_seen;  ///< of the cases that can be seen
  std::map<std::string, ShownScores> by_rig;
  std::map<std::string, ShownScores> by_generator;
  std::map<std::string, ShownScores> by_disturbance;
  std::vector<ShownReliabilityBin> reliability;
  std::map<std::string, ShownRate> coverage;
  std::vector<ShownVerdictError> by_verdict;
  ShownSplices splices;
  std::vector<ShownDetectionBin> by_size;
  std::vector<ShownDetectionBin> by_trace;
  std::vector<ShownEffectScore> by_effect;
  std::vector<ShownConfusion> confusion;
  std::vector<ShownTwin> twins;
  std::vector<std::string> not_concealed;
  std::vector<ShownTrialCase> cases;
};

/// Reads DIR/trial.json. Errors: input_missing; bad_data, naming the file, when it is not the
/// result of a trial or its checksum does not hold.
Result<TrialView> read_trial(const std::filesystem::path& folder);

using TrialSectionRow = SectionOf<TrialView>;

/// Every section of a trial, one file each in reports/trial.
std::span<const TrialSectionRow> trial_sections();

}  // namespace flexspline::reports
