#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "flexspline/studies/conceal.hpp"
#include "flexspline/studies/diagnosis.hpp"
#include "flexspline/studies/planned_study.hpp"

namespace flexspline::studies {

inline constexpr std::string_view kTrialCaseSchema = "flexspline-trial-case/1";
inline constexpr std::string_view kTrialResultSchema = "flexspline-trial-result/1";

/// A blind trial as read. SI.
struct TrialConfig {
  std::filesystem::path file;
  std::filesystem::path data_root;
  std::string name;
  std::string title;
  std::uint64_t seed = 1;
  std::vector<std::string> generators = {"bench"};  ///< ids of rows of studies/generators
  std::filesystem::path mujoco_script;              ///< of the generator "mujoco"
  std::vector<std::filesystem::path> spliced_sets;  ///< of "splice": recordings by others
  std::vector<data::BenchKind> rigs;
  int cases = 0;
  double time_limit = 180.0;  ///< s; a diagnosis that takes longer has failed
  ConcealDraw draw;
  std::map<std::string, double> nuisances;
};

/// A trial as far as it could be read: everything wrong at once.
struct TrialReading {
  std::optional<TrialConfig> trial;  ///< present only when there are no errors
  std::vector<data::Finding> errors;
};

/// Reads a trial of format "flexspline-trial/1" (docs/trials.md).
/// data_root: where the data sets to splice into lie; empty: beside the file.
/// Errors: input_missing when the file cannot be read. What is wrong in it is in the reading.
Result<TrialReading> read_trial(const std::filesystem::path& file,
                                const std::filesystem::path& data_root = {});

/// The same of text that was read from that file.
TrialReading read_trial_text(const std::string& text, const std::filesystem::path& file,
                             const std::filesystem::path& data_root);

/// The same for callers that go no further on a failure.
/// Errors: input_missing, or bad_data with every finding.
Result<TrialConfig> load_trial(const std::filesystem::path& file,
                               const std::filesystem::path& data_root = {});

/// One bench of a trial. Depends on the trial's seed and the case's number alone, not on how many
/// cases there are.
struct TrialCase {
  std::string key;  ///< "case-0007"
  ConcealPlan plan;
};

/// Generators take turns, and with each its rigs, of those that the trial asks for; kinds come in
/// their shares, evenly spread; every rig's effects come in turn, in an order of their own, so that
/// all are tried about equally often. What is spliced goes through the recordings: each as it is,
/// then changed, then with an effect of the smallest and the largest size.
std::vector<TrialCase> plan_trial(const TrialConfig& trial);

/// What a case was, by what it hides.
/// kept, spliced: recordings by others without and with an effect added; what they hide themselves
/// nobody knows.
enum class CaseKind { null, single, pair, unknown, contained, incident, kept, spliced };

std::string_view name_of(CaseKind kind);

/// The names of a diagnosis held against the truth.
struct NameScore {
  bool first_right = false;  ///< single: the first name is right
  bool exact = false;        ///< single: and the only one
  bool pair_both = false;
  bool pair_one = false;
  bool contained_right = false;  ///< contained: adequate, or its own name and no other
  int false_names = 0;           ///< causes that are not there
};

/// A name as it was given. Shares of peak torque.
struct GivenName {
  std::string effect;
  bool right = false;  ///< by the truth's class, whatever alternatives it was given with
  double probability = kNotComputed;
};

/// An interval that was printed, of a parameter that the truth has under the same name and unit.
struct GivenInterval {
  std::string parameter;  ///< "backlash half_gap_rad"
  double lower = kNotComputed;
  double upper = kNotComputed;
  double truth = kNotComputed;  ///< with the sign of what was found: that is each formula's own

  bool covers() const { return lower <= truth && truth <= upper; }
};

/// A diagnosis held against the truth. Right is a name of the truth's class: the effect itself,
/// what the bench says is right for it, or a structural twin.
struct CaseScore : NameScore {
  CaseKind kind = CaseKind::null;
  bool failed = false;            ///< no diagnosis
  bool null_right = false;        ///< null: adequate, and no name
  bool detected = false;          ///< the verdict is neither adequate nor undecided
  bool unknown_right = false;     ///< unknown, incident: something is left out, and has no name
  bool incident_found = false;    ///< incident: its recording and interval are told
  double overlap = kNotComputed;  ///< incident: intersection over union of the intervals
  int named = 0;                  ///< causes
  bool located = false;           ///< a right coordinate among the first three mismatches
  bool has_coordinate = false;    ///< the truth has one
  std::string first_name;         ///< "adequate", "undecided", "no name", or an effect
  /// The same where a cause counts as right, too, when one of its first two alternatives is.
  NameScore with_alternatives;
  std::vector<GivenName> names;
  std::vector<GivenInterval> intervals;
  double over_noise = kNotComputed;        ///< hold-out after over the noise, whatever is hidden
  double after_over_noise = kNotComputed;  ///< the same of named cases
  double after_over_best = kNotComputed;   ///< over what the true drive leaves
  double gain_share = kNotComputed;        ///< (before - after) / (before - best)
};

/// Scores one case. diagnosis = nullptr: it failed.
CaseScore score_case(const ConcealedAnswer& answer, const Diagnosis* diagnosis);

/// What is left of a concealed effect when the baseline has taken up what it can, in the equation
/// that shows most of it.
struct EffectTrace {
  std::string effect;
  /// 99th percentile of the trace over the largest torque of the equation.
  double share = kNotComputed;
  double sigma = kNotComputed;  ///< root of its chi square: how far it stands out of the noise
};

/// A scored case among others.
struct ScoredCase {
  std::string key;
  ConcealedAnswer answer;
  std::string verdict;  ///< or "failed"
  std::vector<std::string> named;
  std::vector<EffectTrace> traces;  ///< of the effects, by name; empty: nothing is hidden
  CaseScore score;
  double seconds = kNotComputed;  ///< of the diagnosis; in no artefact
  std::string failure;            ///< why there is no diagnosis

  /// Smallest share of the traces; infinite where nothing is hidden.
  double least_trace() const;
};

/// Cases whose every effect leaves a trace of at least the size below which a diagnosis names
/// nothing, and those where nothing is hidden.
std::vector<ScoredCase> that_can_be_seen(const std::vector<ScoredCase>& cases);

/// A share with the 95 % interval of Wilson (1927), from so many successes in so many trials: the
/// probabilities p with |share - p| <= 1.96 sqrt(p (1 - p)/n). [0, 1] without trials.
struct Proportion {
  int count = 0;
  int of = 0;
  double lower = 0.0;
  double upper = 1.0;

  double rate() const { return of > 0 ? static_cast<double>(count) / of : kNotComputed; }
};

Proportion proportion(int count, int of);

/// The counters of a set of cases, under the names of docs/trials.md.
struct TrialScores {
  std::vector<std::pair<std::string, int>> counters;
  std::vector<std::pair<std::string, Proportion>> rates;
  std::vector<std::pair<std::string, double>> medians;  ///< and seconds_max

  int counter(std::string_view name) const;
  Proportion rate(std::string_view name) const;
  double median(std::string_view name) const;
};

TrialScores score_trial(const std::vector<ScoredCase>& cases);

/// Names given with a probability in [from, to): of those at p, p should be right.
struct ReliabilityBin {
  double from = 0.0;
  double to = 0.0;
  double mean_probability = kNotComputed;
  Proportion right;
};

std::vector<ReliabilityBin> reliability_of(const std::vector<ScoredCase>& cases);

/// How often printed 95 % intervals hold the truth, by parameter; "all" first.
std::vector<std::pair<std::string, Proportion>> coverage_of(const std::vector<ScoredCase>& cases);

/// Hold-out error over the noise, by verdict: count and median.
struct VerdictError {
  std::string verdict;
  int count = 0;
  double median = kNotComputed;
};

std::vector<VerdictError> errors_by_verdict(const std::vector<ScoredCase>& cases);

/// Recordings by others with an effect spliced in, or changed, against the same as they are.
struct SpliceScores {
  Proportion found_small;   ///< of the effects below 5 % that the recordings alone do not show
  Proportion found_large;   ///< and of the others
  Proportion same_verdict;  ///< of the changed ones
  double names_shared = kNotComputed;  ///< of these: names in both over names in either, mean
  /// The same of those that are decided: a single loop that is left decides nothing.
  double names_shared_decided = kNotComputed;
  int changed = 0;
  int undecided = 0;  ///< of the changed ones
};

SpliceScores splice_scores(const std::vector<ScoredCase>& cases);

/// Diagnoses recordings; a trial is told which, so that it can be tried with others.
using Diagnose =
    std::function<Result<Diagnosis>(const RecordingSet&, const DiagnosisProgress& progress)>;

/// Where and how a trial runs.
struct TrialSettings {
  RunSettings run;
  std::filesystem::path recordings;  ///< keeps every data set as recordings/<key>; empty: none
  /// Name of the diagnosis where it is not the default one; part of what a case depends on.
  std::map<std::string, std::string> diagnosis;
};

/// What a trial did, with every case that is there.
struct TrialSummary {
  RunSummary run;  ///< failed: diagnoses that failed
  std::vector<ScoredCase> cases;
  std::vector<std::string> not_concealed;  ///< "key: reason": not scored
};

/// Computes what the folder does not yet hold, as run_cases does: conceals each case, writes its
/// commitment, has it diagnosed, unseals and scores it. Errors: of run_cases.
Result<RunSummary> run_trial_cases(const TrialConfig& trial, const TrialSettings& settings,
                                   const Diagnose& diagnose);

/// Every case of the trial that the folder holds. Errors: of CaseStore.
Result<TrialSummary> gather_trial(const TrialConfig& trial, const TrialSettings& settings);

/// DIR/trial.json and DIR/tables. Errors: cannot_write.
Result<void> write_trial(const TrialConfig& trial, const TrialSummary& summary,
                         const RunSettings& settings);

/// The diagnosis of these words, on the threads that so many cases side by side leave to each:
/// "interest", the share of the largest torque below which nothing is named; with "folds" in outer
/// folds, too.
Diagnose diagnose_as(const std::map<std::string, std::string>& words, int jobs);

/// All of it; trial.json and tables unless it was interrupted. Without `diagnose`:
/// diagnose_as(settings.diagnosis). Errors: as above.
Result<TrialSummary> run_trial(const TrialConfig& trial, const TrialSettings& settings,
                               Diagnose diagnose = {});

/// A trial as one more kind of study; settings.run needs its build_id alone.
PlannedStudyPtr plan_trial_study(TrialConfig trial, TrialSettings settings);

}  // namespace flexspline::studies
