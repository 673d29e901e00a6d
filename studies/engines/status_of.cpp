#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "config/locked_json.hpp"
#include "engines/running_note.hpp"
#include "flexspline/core/case_store.hpp"

namespace flexspline::studies {
namespace {

using nlohmann::ordered_json;

constexpr std::size_t kTold = 20;  // failures

/// Name and number of cases of the study that is locked here.
Result<StudyStatus> locked_in(const std::filesystem::path& folder) {
  const auto path = folder / "study.lock.toml";
  const auto lock = read_lock_json(path);
  if (!lock) {
    return failure(ErrorCode::input_missing,
                   fmt::format("{} holds no study: {}", folder.string(), lock.error().problem),
                   "give the folder that run, fit or compare writes");
  }
  try {
    StudyStatus status;
    status.name = lock->at("study").value("name", "");
    const auto listed = lock->find("cases");
    status.cases = lock->value("count", listed == lock->end() ? std::size_t{0} : listed->size());
    return status;
  } catch (const nlohmann::json::exception&) {
    return failure(ErrorCode::bad_data,
                   path.string() +
                       ": [study] with the study's name, or the number of its cases "
                       "('count'), is missing or is something else",
                   "it is damaged: run the study into another folder");
  }
}

}  // namespace

Result<StudyStatus> status_of(const std::filesystem::path& folder) {
  auto locked = locked_in(folder);
  if (!locked) return locked;
  StudyStatus& status = *locked;
  const auto store = CaseStore::open(folder, [&](const CaseHead& head) {
    status.seconds += head.seconds;
    if (head.failure.empty() || status.failures.size() == kTold) return;
    status.failures.push_back(fmt::format("{}: {}", head.key, head.failure));
  });
  if (!store) return tl::unexpected(store.error());
  status.done = store->size();
  status.failed = store->failed();
  status.damaged = store->damaged();
  status.running = running_in(folder);
  double rate = 0.0;
  for (const RunningShard& one : status.running) rate += one.state.per_second;
  const auto left = static_cast<double>(status.cases - std::min(status.cases, status.done));
  status.left_seconds = rate > 0.0 ? left / rate : std::nan("");
  return locked;
}

ordered_json to_json(const StudyStatus& status) {
  ordered_json running = ordered_json::array();
  for (const RunningShard& one : status.running) {
    running.push_back({{"who", one.who},
                       {"shard", fmt::format("{}/{}", one.shard.index, one.shard.count)},
                       {"done", one.state.done},
                       {"total", one.state.total},
                       {"per_second", one.state.per_second},
                       {"slowest", one.state.slowest},
                       {"slowest_seconds", one.state.slowest_for},
                       {"silent_seconds", one.silent_for}});
  }
  return {{"study", status.name},
          {"cases", status.cases},
          {"done", status.done},
          {"failed", status.failed},
          {"complete", status.complete()},
          {"case_seconds", status.seconds},
          {"left_seconds",
           std::isnan(status.left_seconds) ? ordered_json() : ordered_json(status.left_seconds)},
          {"running", running},
          {"failures", status.failures},
          {"damaged", status.damaged}};
}

}  // namespace flexspline::studies
