#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "flexspline/core/error.hpp"
#include "flexspline/core/recording.hpp"
#include "flexspline/studies/study_config.hpp"

namespace flexspline::studies {

/// One estimator on one input and replicate: a cell of the study.
struct CasePlan {
  std::string key;  ///< "<input>--<estimator>--r<replicate>"
  const InputConfig* input = nullptr;
  const EstimatorConfig* estimator = nullptr;
  int replicate = 0;
  std::uint64_t seed = 0;
  std::vector<std::string> train;    ///< ids of the training recordings
  std::vector<std::string> holdout;  ///< ids of the recordings that are held out
  long train_samples = 0;
  std::string fit_depends_on;  ///< SHA-256 over what its estimate depends on: equal, computed once
  std::string depends_on;      ///< SHA-256 over everything the case's result depends on
};

/// One input and replicate with its recordings.
struct InputPlan {
  std::string key;  ///< "<input>" for replicate 0, else "<input>-r<replicate>"
  const InputConfig* input = nullptr;
  int replicate = 0;
  std::uint64_t seed = 0;
  std::vector<Loop> train_loops;  ///< of the bench: the union over its estimators
  std::vector<Loop> holdout_loops;
  std::string depends_on;
};

/// What a run of a study will do. Points into the study, which has to outlive it.
struct StudyPlan {
  const StudyConfig* study = nullptr;
  std::vector<InputPlan> inputs;
  std::vector<CasePlan> cases;
  std::map<std::string, RecordingSet> datasets;  ///< by input id, split already decided
  std::map<std::string, std::string> notes;      ///< by input id: how the recordings were split
  double estimated_seconds = 0.0;                ///< on one worker, by a rule of thumb
  double estimated_bytes = 0.0;
};

/// Plans every case. build_id names the program: results of another build are not taken over.
/// Errors: input_missing or bad_data when a data set cannot be read, with the input's id.
Result<StudyPlan> plan_study(const StudyConfig& study, const std::string& build_id);

/// Seed of a replicate: the study's seed plus its number.
std::uint64_t seed_of(const StudyConfig& study, int replicate);

/// Decides train and hold-out of recordings, by whole recordings. Where the file marks training
/// recordings, everything else is held out. Where it does not, what it marks as hold-out stays so,
/// and of the others about one in three is held out, spread over their motion ranges, never the one
/// with the largest and (from three on) never the one with the smallest range. One recording alone
/// is trained on; of two the smaller is held out. Gives a sentence that says what was done.
std::string split_recordings(std::span<TorsionRecord> records);

}  // namespace flexspline::studies
