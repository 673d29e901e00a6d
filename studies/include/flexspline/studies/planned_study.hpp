#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "flexspline/core/error.hpp"
#include "flexspline/studies/pilot.hpp"
#include "flexspline/studies/run.hpp"

namespace flexspline::studies {

/// A study as commands see it, whatever its kind: planned, run in parts, gathered, computed again.
class PlannedStudy {
 public:
  virtual ~PlannedStudy() = default;

  virtual std::string name() const = 0;
  virtual std::string kind() const = 0;
  virtual std::size_t size() const = 0;
  virtual std::filesystem::path file() const = 0;  ///< empty: no file describes it
  virtual std::string text() const = 0;            ///< of the file, as it was read
  /// What it reads beside the file, as far as it is to be kept apart from what is written.
  virtual std::vector<std::filesystem::path> reads() const = 0;
  /// SHA-256 of its data sets by the ids of their inputs.
  virtual std::map<std::string, std::string> data() const { return {}; }
  /// How its recordings were split, a sentence an input.
  virtual std::map<std::string, std::string> notes() const { return {}; }
  /// What there is to know before it runs, beside its size, and each case.
  virtual nlohmann::ordered_json summary() const = 0;
  virtual nlohmann::ordered_json case_summary(std::size_t number) const = 0;
  /// From cases that are computed for that and thrown away, about so many seconds long.
  virtual Pilot pilot(double seconds) const = 0;

  /// Computes what the folder does not hold yet, or its shard of that. Errors: of run_cases.
  virtual Result<RunSummary> run(const RunSettings& settings) const = 0;
  /// What the folder holds, as if it had just been run. Errors: of CaseStore::open.
  virtual Result<RunSummary> done(const std::filesystem::path& folder) const = 0;
  /// Results and tables from the cases that are there; the rest of what is made of them is no part
  /// of a verification (answers alone). Errors: cannot_write.
  virtual Result<void> gather(const std::filesystem::path& folder, const RunSettings& settings,
                              bool answers_alone = false) const = 0;
};

using PlannedStudyPtr = std::unique_ptr<const PlannedStudy>;

/// A study of estimators on inputs. Errors: of plan_study.
Result<PlannedStudyPtr> plan_fits(StudyConfig study, const std::string& build_id);

/// Any study file: by its schema one of the kinds, or a blind trial.
/// Errors: of load_study, load_trial and plan_study.
Result<PlannedStudyPtr> plan_file(const std::filesystem::path& file,
                                  const std::filesystem::path& data_root,
                                  const std::string& build_id);

/// What a study says otherwise than the one that was computed in a folder, key by key with both
/// values; empty where only comments and layout differ. Nothing where no study file is known there.
std::optional<std::vector<std::string>> differences_from(const std::filesystem::path& folder,
                                                         const PlannedStudy& study);

/// Inputs whose data sets are not those that a folder was computed from, by their ids.
std::vector<std::string> changed_data(const std::filesystem::path& folder,
                                      const PlannedStudy& study);

/// The study of a folder, from its study.lock.toml. Errors: as above, of read_locked_study.
Result<PlannedStudyPtr> plan_locked(const std::filesystem::path& lock,
                                    const std::filesystem::path& data_root,
                                    const std::string& build_id);

}  // namespace flexspline::studies
