#pragma once

#include "diagnosis/finding.hpp"

namespace flexspline::studies {

/// The recordings of a set but for those of these ids.
/// Errors: usage, an id that the set has not, or every recording.
Result<RecordingSet> without(const RecordingSet& set, const std::vector<std::string>& ids);

/// Errors of the baseline and of what was found on recordings that were taken away before anything
/// was looked for: every parameter is fitted to the others, whose causes and forms stand, and the
/// rest is read off once. Where mountings have zeros of their own, each of these recordings is
/// counted from where it is unloaded.
/// Errors: those of fits.
struct JudgedOnce {
  HoldoutProof proof;
  std::vector<DiagnosedSeries> series;  ///< of the recordings taken away
};
Result<JudgedOnce> judged_once(const RecordingSet& all, const std::vector<std::string>& ids,
                               const Finding& finding, Eigen::Index most_rows);

}  // namespace flexspline::studies
