#include "engines/case_queue.hpp"

#include <algorithm>
#include <limits>
#include <new>

#include <fmt/format.h>

#include "flexspline/data/checksum.hpp"

namespace flexspline::studies {
namespace {

StoredCase stored(const CaseName& name, CaseResult result) {
  return {name.key,       name.depends_on,       std::move(result.failure),
          result.seconds, std::move(result.row), std::move(result.artefact)};
}

}  // namespace

bool Shard::has(std::size_t number, std::size_t total) const {
  if (whole()) return true;
  constexpr std::size_t kLargestPack = 64;
  const std::size_t pack = std::clamp<std::size_t>(total / (8 * count), 1, kLargestPack);
  return (number / pack) % count == index - 1;
}

CaseQueue::CaseQueue(CaseSource& source, const EngineSettings& settings, std::size_t workers)
    : source_(&source),
      settings_(&settings),
      workers_(std::make_unique<Worker[]>(workers)),
      worker_count_(workers) {}

Result<std::vector<bool>> CaseQueue::done_in_folder() const {
  const auto store = CaseStore::open(settings_->folder);
  if (!store) return tl::unexpected(store.error());
  std::vector<bool> done(source_->size());
  if (store->size() == 0) return done;
  for (std::size_t number = 0; number < done.size(); ++number) {
    done[number] = store->contains(CaseStore::digest_of(source_->name(number).depends_on));
  }
  return done;
}

Result<void> CaseQueue::plan_pulling(const std::string& who) {
  auto done = done_in_folder();
  if (!done) return tl::unexpected(done.error());
  const std::size_t total = source_->size();
  summary_.reused = static_cast<std::size_t>(std::ranges::count(*done, true));
  const std::string study =
      data::sha256_hex(fmt::format("{} {} {}", total, source_->name(0).depends_on,
                                   source_->name(total - 1).depends_on))
          .substr(0, 16);
  const Pulling& pulling = settings_->pulling;
  puller_.emplace(total, Claims(settings_->folder, study, who, pulling.lease_seconds), pulling,
                  std::move(*done), [this] { return done_in_folder(); });
  return {};
}

Result<void> CaseQueue::plan(const std::string& who) {
  if (settings_->pulling.on && source_->size() > 0) return plan_pulling(who);
  std::map<std::string, std::string, std::less<>> failures;  // of earlier runs, by depends_on
  const auto store = CaseStore::open(settings_->folder, [&](const CaseHead& head) {
    if (!head.failure.empty()) failures.emplace(head.depends_on, head.failure);
  });
  if (!store) return tl::unexpected(store.error());
  summary_.damaged = store->damaged();
  const std::size_t total = source_->size();
  std::vector<CaseStore::Digest> planned;
  for (std::size_t number = 0; number < total; ++number) {
    const bool own = settings_->shard.has(number, total);
    if (own) ++summary_.cases;
    if (store->size() == 0) {
      if (own) todo_.push_back(number);
      continue;
    }
    if (!own) continue;
    const CaseName name = source_->name(number);
    const CaseStore::Digest digest = CaseStore::digest_of(name.depends_on);
    planned.push_back(digest);
    if (!store->contains(digest)) {
      todo_.push_back(number);
      continue;
    }
    ++summary_.reused;
    if (const auto failed = failures.find(name.depends_on); failed != failures.end()) {
      note_failure(name.key, failed->second);
    }
  }
  std::ranges::sort(planned);
  return settings_->shard.whole() ? set_stale_aside(*store, planned) : Result<void>{};
}

Result<void> CaseQueue::set_stale_aside(const CaseStore& store,
                                        const std::vector<CaseStore::Digest>& planned) {
  const std::size_t stale = store.size() - summary_.reused;
  if (stale == 0 && store.damaged().empty()) return {};
  const auto keep = [&](JournalFields fields) {
    return fields.size() > 1 &&
           std::ranges::binary_search(planned, CaseStore::digest_of(fields[1]));
  };
  const auto done = JournalWriter::set_aside(settings_->folder / "journals", keep);
  if (!done) return tl::unexpected(done.error());
  if (*done && stale > 0 && settings_->log) {
    settings_->log(fmt::format("{} earlier case{} not part of the study any more: set aside", stale,
                               stale == 1 ? " is" : "s are"));
  }
  return {};
}

bool CaseQueue::take_pack() {
  const std::chrono::duration<double> spent = EngineClock::now() - start_;
  const std::size_t computed = computed_;
  auto taken = puller_->take(computed > 0 ? spent.count() / static_cast<double>(computed)
                                          : std::numeric_limits<double>::quiet_NaN());
  if (!taken) {
    break_off(taken.error());
    return false;
  }
  todo_.insert(todo_.end(), taken->cases.begin(), taken->cases.end());
  return taken->later;
}

std::size_t CaseQueue::pull(std::size_t worker) {
  workers_[worker].since = 0;
  const std::scoped_lock lock(pulling_);
  const bool stop = broken_ || (settings_->stop != nullptr && *settings_->stop);
  if (stop) {
    stopped_ = stopped_ || next_ < todo_.size() || (puller_ && puller_->untaken() > 0);
    return none();
  }
  const bool later = puller_ && next_ == todo_.size() && take_pack();
  if (next_ == todo_.size()) return later ? this->later() : none();
  const std::size_t number = todo_[next_++];
  workers_[worker].number = number;
  workers_[worker].since = EngineClock::now().time_since_epoch().count();
  return number;
}

Result<StoredCase> CaseQueue::compute(std::size_t number) {
  try {
    CaseResult result = source_->compute(number);
    if (result.broken) return tl::unexpected(std::move(*result.broken));
    return stored(source_->name(number), std::move(result));
  } catch (const std::bad_alloc&) {
    const double limit = settings_->limits.memory_mb;
    return give_up(number, {ErrorCode::numerics,
                            limit > 0.0 ? fmt::format("it needs more than {:g} MB of memory, the "
                                                      "limit of a case",
                                                      limit)
                                        : "there is not enough memory",
                            "allow the case more memory, or make it smaller",
                            {}});
  } catch (const std::exception& error) {
    return give_up(number,
                   {ErrorCode::defect, error.what(), "please report it with the study file", {}});
  }
}

StoredCase CaseQueue::give_up(std::size_t number, const Error& why) {
  return stored(source_->name(number), source_->give_up(number, why));
}

void CaseQueue::count(std::size_t worker, const StoredCase& one) {
  workers_[worker].since = 0;
  ++computed_;
  if (!one.failed()) return;
  const std::scoped_lock lock(mutex_);
  note_failure(one.key, one.failure);
  if (settings_->log) settings_->log(fmt::format("case {}: {}", one.key, one.failure));
}

void CaseQueue::note_failure(std::string_view key, std::string_view reason) {
  ++failed_;
  if (summary_.failures.size() < kMostFailures) {
    summary_.failures.push_back(fmt::format("{}: {}", key, reason));
  }
}

void CaseQueue::break_off(const Error& error) {
  const std::scoped_lock lock(mutex_);
  if (!error_) error_ = error;
  broken_ = true;
}

Progress CaseQueue::progress() const {
  const auto now = EngineClock::now();
  Progress state;
  state.done = summary_.reused + computed_;
  state.total = settings_->pulling.on ? source_->size() : summary_.cases;
  state.failed = failed_;
  state.seconds = std::chrono::duration<double>(now - start_).count();
  state.per_second = static_cast<double>(computed_) / std::max(1e-9, state.seconds);
  std::size_t slowest = none();
  for (std::size_t w = 0; w < worker_count_; ++w) {
    const EngineClock::rep since = workers_[w].since;
    if (since == 0) continue;
    const EngineClock::time_point begun{EngineClock::duration(since)};
    const double seconds = std::chrono::duration<double>(now - begun).count();
    if (seconds <= state.slowest_for) continue;
    state.slowest_for = seconds;
    slowest = workers_[w].number;
  }
  if (slowest != none()) state.slowest = source_->name(slowest).key;
  return state;
}

Result<EngineSummary> CaseQueue::summary() const {
  const std::scoped_lock lock(mutex_);
  if (error_) return tl::unexpected(*error_);
  EngineSummary summary = summary_;
  if (puller_) summary.cases = summary.reused + todo_.size();
  summary.computed = computed_;
  summary.failed = failed_;
  summary.interrupted = stopped_ || summary.computed < todo_.size();
  std::ranges::sort(summary.failures);
  return summary;
}

}  // namespace flexspline::studies
