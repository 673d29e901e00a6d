#include "flexspline/studies/run.hpp"

#include <algorithm>
#include <chrono>
#include <mutex>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "flexspline/data/artefact.hpp"
#include "flexspline/data/checksum.hpp"
#include "flexspline/studies/paper_facts.hpp"
#include "inputs/input_cache.hpp"
#include "run/compute_case.hpp"
#include "run/study_folder.hpp"
#include "run/worker_pool.hpp"

namespace flexspline::studies {
namespace {

using Clock = std::chrono::steady_clock;

/// One run: what is left to do, and what became of it.
class Run {
 public:
  Run(const StudyPlan& plan, const RunSettings& settings)
      : plan_(plan), settings_(settings), cache_(plan) {}

  Result<RunSummary> operator()();

 private:
  void plan_inputs();
  void plan_cases();
  void plan_paper();
  bool write_input(const InputPlan& input);
  bool write_case(const CasePlan& one);
  bool finished(const Result<void>& written);
  void count_case(const CasePlan& one, const CaseOutcome& outcome);
  void report_progress();
  const InputPlan& input_of(const CasePlan& one) const;

  const StudyPlan& plan_;
  const RunSettings& settings_;
  InputCache cache_;
  std::vector<std::function<bool()>> tasks_;
  std::mutex mutex_;
  RunSummary summary_;
  std::optional<Error> error_;
  Clock::time_point start_ = Clock::now();
};

const InputPlan& Run::input_of(const CasePlan& one) const {
  return *std::ranges::find_if(plan_.inputs, [&](const InputPlan& input) {
    return input.input == one.input && input.replicate == one.replicate;
  });
}

void Run::plan_inputs() {
  std::set<std::string> kept;
  for (const InputPlan& input : plan_.inputs) {
    if (input.replicate != 0) continue;  // replicates differ by their noise alone
    kept.insert(input.key + ".json");
    const auto file = settings_.folder / "inputs" / (input.key + ".json");
    if (find_valid(file, kInputSchema, input.depends_on)) continue;
    cache_.reserve(input);
    tasks_.emplace_back([this, &input] { return write_input(input); });
  }
  set_aside(settings_.folder / "inputs", kept, settings_);
}

void Run::plan_cases() {
  std::set<std::string> kept;
  summary_.cases = plan_.cases.size();
  for (const CasePlan& one : plan_.cases) {
    kept.insert(one.key + ".json");
    const auto file = settings_.folder / "cases" / (one.key + ".json");
    if (const auto earlier = find_valid(file, kCaseSchema, one.depends_on)) {
      ++summary_.reused;
      if (earlier->failed) summary_.failed.push_back(one.key + ": " + earlier->reason);
      continue;
    }
    cache_.reserve(input_of(one));
    tasks_.emplace_back([this, &one] { return write_case(one); });
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
  const InputCache::Prepared prepared = cache_.take(input);
  if (!*prepared) return true;  // every case of it says why
  return finished(data::write_artefact(settings_.folder / "inputs" / (input.key + ".json"),
                                       input_json(**prepared)));
}

bool Run::write_case(const CasePlan& one) {
  const InputCache::Prepared prepared = cache_.take(input_of(one));
  const CaseOutcome outcome = compute_case(one, *prepared);
  const PreparedInput* input = prepared->has_value() ? &prepared->value() : nullptr;
  const bool written = finished(data::write_artefact(
      settings_.folder / "cases" / (one.key + ".json"), case_json(one, input, outcome)));
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
