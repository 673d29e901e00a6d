#include "flexspline/studies/run.hpp"

#include <algorithm>
#include <chrono>
#include <map>
#include <mutex>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "flexspline/core/signals.hpp"
#include "flexspline/data/artefact.hpp"
#include "flexspline/data/checksum.hpp"
#include "flexspline/studies/paper_facts.hpp"
#include "inputs/once.hpp"
#include "results/results_table.hpp"
#include "run/compute_case.hpp"
#include "run/study_folder.hpp"
#include "run/wall_times.hpp"
#include "run/worker_pool.hpp"

namespace flexspline::studies {
namespace {

using Clock = std::chrono::steady_clock;

/// One run: what is left to do, and what became of it.
class Run {
 public:
  Run(const StudyPlan& plan, const RunSettings& settings);

  Result<RunSummary> operator()();

 private:
  using Inputs = Once<const InputPlan*, Result<PreparedInput>>;

  void plan_smoothing();
  void plan_inputs();
  void plan_cases();
  void plan_paper();
  bool write_input(const InputPlan& input);
  bool write_case(const CasePlan& one, std::size_t number);
  Inputs::Shared take(const InputPlan& input);
  bool finished(const Result<void>& written);
  void count_case(const CasePlan& one, const CaseOutcome& outcome);
  void report_progress();
  const InputPlan& input_of(const CasePlan& one) const;

  const StudyPlan& plan_;
  const RunSettings& settings_;
  std::map<std::pair<const InputConfig*, int>, const InputPlan*> input_plans_;
  Inputs inputs_;
  Once<std::string, Result<Estimate>> estimates_;  ///< by fit_depends_on
  std::vector<std::function<bool()>> tasks_;
  std::mutex mutex_;
  RunSummary summary_;
  std::optional<Error> error_;
  Clock::time_point start_ = Clock::now();
};

Run::Run(const StudyPlan& plan, const RunSettings& settings) : plan_(plan), settings_(settings) {
  for (const InputPlan& input : plan.inputs) {
    input_plans_.emplace(std::pair(input.input, input.replicate), &input);
  }
}

const InputPlan& Run::input_of(const CasePlan& one) const {
  return *input_plans_.at({one.input, one.replicate});
}

Run::Inputs::Shared Run::take(const InputPlan& input) {
  return inputs_.take(&input, [&] { return prepare_input(plan_, input); });
}

/// What is measured is smoothed recording by recording, for all cases at once: few cases of many
/// recordings keep every worker busy, too.
void Run::plan_smoothing() {
  std::vector<std::function<bool()>> smoothing;
  for (const InputPlan& input : plan_.inputs) {
    const auto set = plan_.datasets.find(input.input->id);
    if (set == plan_.datasets.end() || input.replicate != 0) continue;
    for (std::size_t i = 0; i < set->second.recordings.size(); ++i) {
      inputs_.reserve(&input);
      smoothing.emplace_back([this, &input, i] {
        const Inputs::Shared prepared = take(input);
        if (*prepared) static_cast<void>(reconstruct((*prepared)->recordings.at(i).record));
        return true;
      });
    }
  }
  if (!tasks_.empty()) tasks_.insert(tasks_.begin(), smoothing.begin(), smoothing.end());
}

void Run::plan_inputs() {
  std::set<std::string> kept;
  for (const InputPlan& input : plan_.inputs) {
    if (input.replicate != 0) continue;  // replicates differ by their noise alone
    kept.insert(input.key + ".json");
    const auto file = settings_.folder / "inputs" / (input.key + ".json");
    if (find_valid(file, kInputSchema, input.depends_on)) continue;
    inputs_.reserve(&input);
    tasks_.emplace_back([this, &input] { return write_input(input); });
  }
  set_aside(settings_.folder / "inputs", kept, settings_);
}

void Run::plan_cases() {
  std::set<std::string> kept;
  summary_.cases = plan_.cases.size();
  summary_.rows.resize(plan_.cases.size());
  for (std::size_t i = 0; i < plan_.cases.size(); ++i) {
    const CasePlan& one = plan_.cases[i];
    kept.insert(one.key + ".json");
    const auto file = settings_.folder / "cases" / (one.key + ".json");
    if (auto earlier = find_valid(file, kCaseSchema, one.depends_on)) {
      ++summary_.reused;
      if (earlier->failed) summary_.failed.push_back(one.key + ": " + earlier->reason);
      summary_.rows[i] = std::move(earlier->row);
      continue;
    }
    inputs_.reserve(&input_of(one));
    estimates_.reserve(one.fit_depends_on);
    tasks_.emplace_back([this, &one, i] { return write_case(one, i); });
  }
  set_aside(settings_.folder / "cases", kept, settings_);
}

void Run::plan_paper() {
  if (!plan_.study->paper) return;
  const auto file = settings_.folder / "paper.json";
  const std::string depends_on =
      data::sha256_hex(settings_.build_id + describe_study(*plan_.study));
  if (find_valid(file, kPaperSchema, depends_on)) return;
  tasks_.emplace_back([this, file, depends_on] {
    const Result<void> written = write_paper(*plan_.study, depends_on, file);
    if (written || written.error().code == ErrorCode::cannot_write) return finished(written);
    const std::scoped_lock lock(mutex_);
    summary_.failed.push_back("paper: " + written.error().message());
    return true;
  });
}

bool Run::write_input(const InputPlan& input) {
  const Inputs::Shared prepared = take(input);
  if (!*prepared) return true;  // every case of it says why
  return finished(data::write_artefact(settings_.folder / "inputs" / (input.key + ".json"),
                                       input_json(**prepared)));
}

bool Run::write_case(const CasePlan& one, std::size_t number) {
  const Inputs::Shared prepared = take(input_of(one));
  const auto estimate =
      estimates_.take(one.fit_depends_on, [&] { return estimate_case(one, *prepared); });
  const CaseOutcome outcome = compare_case(one, *prepared, *estimate);
  const PreparedInput* input = prepared->has_value() ? &prepared->value() : nullptr;
  const nlohmann::ordered_json artefact = case_json(one, input, outcome);
  summary_.rows[number] = row_of(artefact);  // every case has its own
  const bool written =
      finished(data::write_artefact(settings_.folder / "cases" / (one.key + ".json"), artefact)) &&
      (!outcome.estimate ||
       finished(add_wall_time(settings_.folder, one.key, outcome.estimate->seconds)));
  if (written) count_case(one, outcome);
  return written;
}

bool Run::finished(const Result<void>& written) {
  if (written) return true;
  const std::scoped_lock lock(mutex_);
  if (!error_) error_ = written.error();
  return false;
}

void Run::count_case(const CasePlan& one, const CaseOutcome& outcome) {
  const std::scoped_lock lock(mutex_);
  ++summary_.computed;
  if (!outcome.estimate) {
    summary_.failed.push_back(one.key + ": " + outcome.estimate.error().message());
    if (settings_.log) settings_.log("case " + summary_.failed.back());
  }
  report_progress();
}

void Run::report_progress() {
  if (!settings_.progress) return;
  const std::chrono::duration<double> elapsed = Clock::now() - start_;
  settings_.progress({summary_.computed + summary_.reused, summary_.cases, summary_.failed.size(),
                      elapsed.count()});
}

Result<RunSummary> Run::operator()() {
  if (const auto locked = write_lock(plan_, settings_); !locked) {
    return tl::unexpected(locked.error());
  }
  plan_paper();
  plan_inputs();
  plan_cases();
  plan_smoothing();
  const bool all = run_tasks(tasks_, settings_.jobs, settings_.stop);
  if (error_) return tl::unexpected(*error_);
  summary_.interrupted = !all;
  std::ranges::sort(summary_.failed);
  summary_.seconds = std::chrono::duration<double>(Clock::now() - start_).count();
  return summary_;
}

}  // namespace

Result<RunSummary> run_study(const StudyPlan& plan, const RunSettings& settings) {
  return Run(plan, settings)();
}

}  // namespace flexspline::studies
