#include <algorithm>
#include <cstdlib>

#include "flexspline/core/in_parallel.hpp"
#include "flexspline/studies/decision.hpp"
#include "flexspline/studies/trial.hpp"

namespace flexspline::studies {

Diagnose diagnose_as(const std::map<std::string, std::string>& words, int jobs) {
  const auto found = static_cast<int>(threads_for(0));
  const auto threads = static_cast<unsigned>(std::max(1, jobs > 0 ? found / jobs : 1));
  const auto engine = words.find("engine");
  if (engine == words.end() || engine->second == "rules") {
    return [threads](const RecordingSet& recordings, const DiagnosisProgress& progress) {
      return diagnose(recordings, progress, {.threads = threads, .nested = false});
    };
  }
  EvidenceSettings settings;
  settings.threads = threads;
  if (const auto least = words.find("interest"); least != words.end()) {
    settings.interest = std::strtod(least->second.c_str(), nullptr);
  }
  return [settings](const RecordingSet& recordings, const DiagnosisProgress& progress) {
    return diagnose_by_evidence(recordings, progress, settings);
  };
}

}  // namespace flexspline::studies
