#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "flexspline/core/error.hpp"
#include "flexspline/core/recording.hpp"
#include "flexspline/studies/study_config.hpp"

namespace flexspline::studies {

/// One estimator on one input and replicate, at one point of every sweep: a case of the study.
struct CasePlan {
  std::string key;  ///< "<input>--<estimator>--r<replicate>", with "--v<variant>" where it is swept
  std::shared_ptr<const StudyConfig> study;  ///< of its variant; input and estimator are its
  const InputConfig* input = nullptr;
  const EstimatorConfig* estimator = nullptr;
  std::size_t variant = 0;
  int replicate = 0;
  std::uint64_t seed = 0;
  std::vector<std::string> train;    ///< ids of the training recordings
  std::vector<std::string> holdout;  ///< ids of the recordings that are held out
  long train_samples = 0;
  std::string fit_depends_on;  ///< SHA-256 over what its estimate depends on: equal, computed once
  std::string depends_on;      ///< SHA-256 over everything the case's result depends on
  std::optional<Error> problem{};  ///< why its variant of the study cannot be
};

/// One input and replicate with its recordings.
struct InputPlan {
  std::string key;  ///< "<input>"; what it is for other replicates and variants has no file
  std::shared_ptr<const StudyConfig> study;
  const InputConfig* input = nullptr;
  int replicate = 0;
  std::uint64_t seed = 0;
  std::vector<Loop> train_loops;  ///< of the bench: the union over its estimators
  std::vector<Loop> holdout_loops;
  std::string depends_on;
};

/// Where a case stands in the plan.
struct CasePlace {
  std::size_t variant = 0;
  std::size_t replicate = 0;
  std::size_t cell = 0;  ///< number of the pair of input and estimator
};

/// A pair of input and estimator, by their numbers, and the sweeps that it depends on: it has cases
/// at every point of those, and at the first point of the others.
struct Cell {
  std::size_t input = 0;
  std::size_t estimator = 0;
  std::vector<bool> swept{};  ///< a sweep each
};

struct VariantPlan;
struct VariantCache;

/// What a run of a study will do. Cases are made when they are asked for, so that a plan of a
/// million takes no more room than one of ten. Points into the study, which has to outlive it.
class StudyPlan {
 public:
  const StudyConfig* study = nullptr;
  std::vector<InputPlan> inputs;                 ///< variant 0 and replicate 0 of each
  std::map<std::string, RecordingSet> datasets;  ///< by input id, split already decided
  std::map<std::string, std::string> notes;      ///< by input id: how the recordings were split
  std::vector<Cell> cells;

  /// Cases. They are numbered by variant, replicate, input and estimator, the last one fastest.
  std::size_t size() const { return first_.back() * static_cast<std::size_t>(study->replicates); }
  CasePlace place(std::size_t number) const;
  CasePlan at(std::size_t number) const;
  /// The input of a case, with the recordings that every estimator needs of it.
  InputPlan input_of(const CasePlan& one) const;
  /// Cases of a cell, and how many different fits they are.
  std::size_t cases_of(const Cell& cell) const;
  std::size_t unique_fits() const;
  const std::string& build_id() const { return build_id_; }

 private:
  friend Result<StudyPlan> plan_study(const StudyConfig& study, const std::string& build_id);

  void number_cells();
  std::shared_ptr<const VariantPlan> variant(std::size_t number) const;

  std::string build_id_;
  std::vector<std::size_t> first_{0};  ///< cells before each variant
  std::shared_ptr<VariantCache> variants_;
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
