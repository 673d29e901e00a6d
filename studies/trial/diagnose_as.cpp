#include <algorithm>
#include <cstdlib>

#include "flexspline/core/in_parallel.hpp"
#include "flexspline/studies/trial.hpp"

namespace flexspline::studies {

Diagnose diagnose_as(const std::map<std::string, std::string>& words, int jobs) {
  const auto found = static_cast<int>(threads_for(0));
  DiagnosisSettings settings;
  settings.nested = words.contains("folds");
  settings.threads = static_cast<unsigned>(std::max(1, jobs > 0 ? found / jobs : 1));
  if (const auto least = words.find("interest"); least != words.end()) {
    settings.interest = std::strtod(least->second.c_str(), nullptr);
  }
  return [settings](const RecordingSet& recordings, const DiagnosisProgress& progress) {
    return diagnose(recordings, progress, settings);
  };
}

}  // namespace flexspline::studies
