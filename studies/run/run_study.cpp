#include "flexspline/studies/run.hpp"

#include <chrono>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "flexspline/core/signals.hpp"
#include "flexspline/data/artefact.hpp"
#include "flexspline/data/checksum.hpp"
#include "flexspline/studies/paper_facts.hpp"
#include "results/findings_json.hpp"
#include "run/artefact_json.hpp"
#include "run/study_cases.hpp"
#include "run/study_folder.hpp"
#include "run/worker_pool.hpp"

namespace flexspline::studies {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

/// What lies beside the cases: the paper's facts and what the inputs themselves show. Several at
/// once; what of data sets is smoothed, is smoothed recording by recording.
class Beside {
 public:
  Beside(const StudyPlan& plan, const RunSettings& settings, StudyCases& cases)
      : plan_(plan), settings_(settings), cases_(cases) {}

  Result<void> operator()() {
    plan_paper();
    plan_inputs();
    static_cast<void>(run_tasks(tasks_, settings_.jobs, settings_.stop));
    if (error_) return tl::unexpected(*error_);
    return {};
  }
  const std::vector<std::string>& failed() const { return failed_; }

 private:
  void plan_paper() {
    if (!plan_.study->paper) return;
    const fs::path file = settings_.folder / "paper.json";
    const std::string depends_on =
        data::sha256_hex(settings_.build_id + describe_study(*plan_.study));
    if (is_valid(file, kPaperSchema, depends_on)) return;
    tasks_.emplace_back([this, file, depends_on] {
      const Result<void> written = write_paper(*plan_.study, depends_on, file);
      if (written || written.error().code == ErrorCode::cannot_write) return finished(written);
      const std::scoped_lock lock(mutex_);
      failed_.push_back("paper: " + written.error().message());
      return true;
    });
  }

  void plan_inputs() {
    std::set<std::string> kept;
    for (const InputPlan& input : plan_.inputs) {
      kept.insert(input.key + ".json");
      const fs::path file = settings_.folder / "inputs" / (input.key + ".json");
      if (is_valid(file, kInputSchema, input.depends_on)) continue;
      plan_smoothing(input);
      tasks_.emplace_back([this, &input, file] {
        const StudyCases::Prepared prepared = cases_.prepared(input);
        if (!*prepared) return true;  // every case of it says why
        auto artefact = input_json(**prepared);
        if (const auto set = plan_.datasets.find(input.input->id); set != plan_.datasets.end()) {
          artefact["findings"] = findings_json(data::sanity_of(set->second));
        }
        return finished(data::write_artefact(file, std::move(artefact)));
      });
    }
    set_aside(settings_.folder / "inputs", kept, settings_);
  }

  void plan_smoothing(const InputPlan& input) {
    const auto set = plan_.datasets.find(input.input->id);
    if (set == plan_.datasets.end()) return;
    for (std::size_t i = 0; i < set->second.recordings.size(); ++i) {
      tasks_.emplace_back([this, &input, i] {
        const StudyCases::Prepared prepared = cases_.prepared(input);
        if (*prepared) static_cast<void>(reconstruct((*prepared)->recordings.at(i).record));
        return true;
      });
    }
  }

  bool finished(const Result<void>& written) {
    if (written) return true;
    const std::scoped_lock lock(mutex_);
    if (!error_) error_ = written.error();
    return false;
  }

  const StudyPlan& plan_;
  const RunSettings& settings_;
  StudyCases& cases_;
  std::vector<std::function<bool()>> tasks_;
  std::mutex mutex_;
  std::vector<std::string> failed_;
  std::optional<Error> error_;
};

}  // namespace

Result<RunSummary> run_study(const StudyPlan& plan, const RunSettings& settings) {
  const Clock::time_point start = Clock::now();
  StudyCases cases(plan);
  if (const auto locked = write_lock(plan, cases, settings); !locked) {
    return tl::unexpected(locked.error());
  }
  set_old_cases_aside(settings);
  // Workers that are processes have to begin before any thread of this one.
  Beside beside(plan, settings, cases);
  const bool first = settings.shard.index == 1;
  if (first && !settings.limits.any()) {
    if (const auto written = beside(); !written) return tl::unexpected(written.error());
  }
  auto ran = run_cases(cases, settings);
  if (!ran) return tl::unexpected(ran.error());
  if (first && settings.limits.any() && !ran->interrupted) {
    if (const auto written = beside(); !written) return tl::unexpected(written.error());
  }
  RunSummary summary = summary_of(std::move(*ran));
  for (const std::string& one : beside.failed()) summary.failed.push_back(one);
  summary.failures += beside.failed().size();
  summary.interrupted = summary.interrupted || (settings.stop != nullptr && *settings.stop);
  summary.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  return summary;
}

}  // namespace flexspline::studies
