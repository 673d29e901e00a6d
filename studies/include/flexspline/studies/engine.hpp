#pragma once

#include <atomic>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "flexspline/core/error.hpp"

namespace flexspline::studies {

/// What a case is called, and SHA-256 (hex) over everything that its result depends on.
struct CaseName {
  std::string key;
  std::string depends_on;
};

/// What became of a case, as it is kept.
struct CaseResult {
  std::string failure{};   ///< why it failed; empty: it did not
  double seconds = 0.0;    ///< wall time of what is worth timing, beside the artefact
  std::string row{};       ///< JSON of what tables ask of it
  std::string artefact{};  ///< data::sealed()
  /// Nothing can be computed here any more, by no fault of the case: the run ends with that.
  std::optional<Error> broken{};
};

/// The cases of a study by their numbers: all that an engine knows of a study. name() and compute()
/// are pure functions of the number, called by many threads at once, in any order.
class CaseSource {
 public:
  virtual ~CaseSource() = default;
  virtual std::size_t size() const = 0;
  virtual CaseName name(std::size_t number) const = 0;
  virtual CaseResult compute(std::size_t number) = 0;
  /// A case that the engine gave up.
  virtual CaseResult give_up(std::size_t number, const Error& why) = 0;
};

/// Part `index` of `count`, from 1. The parts are disjoint and together the whole, each spread over
/// the plan in packs of neighbours, which share their recordings.
struct Shard {
  std::size_t index = 1;
  std::size_t count = 1;

  bool whole() const { return count == 1; }
  bool has(std::size_t number, std::size_t total) const;
};

/// How shards of one folder share it: each takes packs of neighbouring cases from what is left,
/// about so many seconds of its own work at a time, so that a slow case holds up nobody. What was
/// taken is noted in claims/, a file a pack, made by an atomic link; who took it is alive as long
/// as its note in journals/ changes. A pack whose taker is gone is taken again. Two who compute one
/// case by mistake compute the same bytes, and it counts once.
struct Pulling {
  bool on = false;
  double pack_seconds = 10.0;
  double lease_seconds = 30.0;  ///< without a change, after which a taker is gone
};

/// What one case may take; 0: any. With a limit every worker is a process of its own, which is
/// ended where it exceeds one: a failed case with the reason.
struct CaseLimits {
  double seconds = 0.0;
  double memory_mb = 0.0;

  bool any() const { return seconds > 0.0 || memory_mb > 0.0; }
};

/// How far an engine is.
struct Progress {
  std::size_t done = 0;
  std::size_t total = 0;
  std::size_t failed = 0;
  double seconds = 0.0;      ///< since the run began
  double per_second = 0.0;   ///< cases, since it began
  std::string slowest{};     ///< key of the case that has been under way for longest
  double slowest_for = 0.0;  ///< and for how long, s
};

struct EngineSettings {
  std::filesystem::path folder;
  int jobs = 0;  ///< workers; 0: as many as the machine has
  Shard shard{};
  Pulling pulling{};  ///< of shards: instead of the part that their number says
  CaseLimits limits{};
  const std::atomic<bool>* stop = nullptr;  ///< becomes true: finish the cases at hand and return
  std::function<void(const Progress&)>
      progress{};  ///< some times a second, by one thread at a time
  std::function<void(std::string_view)> log{};
};

struct EngineSummary {
  std::size_t cases = 0;  ///< of the shard
  std::size_t computed = 0;
  std::size_t reused = 0;               ///< were there before
  std::size_t failed = 0;               ///< also of those
  std::vector<std::string> failures{};  ///< "key: reason", sorted; at most kMostFailures
  std::vector<std::string> damaged{};   ///< what was lost of the journals, and computed again
  bool interrupted = false;
};

inline constexpr std::size_t kMostFailures = 1000;

/// Computes every case of the shard that the folder does not hold yet, into
/// journals/<host>-<k>.journal, one a worker, each record with its checksum. A case that fails is a
/// result. Killed at any moment it goes on from what is whole; what the plan has no more is set
/// aside, unless somebody else writes into the folder. The artefacts do not depend on the number of
/// workers, shards or interruptions. Errors: cannot_write; bad_data for journals of another
/// version.
Result<EngineSummary> run_cases(CaseSource& source, const EngineSettings& settings);

/// Removes what shards that pulled left in claims/, unless somebody still works in the folder.
void remove_claims(const std::filesystem::path& folder);

}  // namespace flexspline::studies
