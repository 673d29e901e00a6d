#pragma once

#include "diagnosis/names/finding.hpp"

namespace flexspline::studies {

/// What a search that never saw them leaves of the rows that were taken away.
struct Judged {
  Frame frame;             ///< of all recordings
  Eigen::ArrayXd held;     ///< usable rows that were taken away, and that smoothing has hold of
  ModelFit before, after;  ///< the baseline and what was found, all rows
  PerEquation of_motion;   ///< torque_of_motion_error() of what was found
};

/// Every parameter is fitted once more to the rows that the search had, whose causes and forms
/// stand, and the others are read off once. whole: the frame of all recordings, as it was made;
/// held: 1 in each row that was taken away. From its first such row on nothing of a recording is
/// fitted. Where mountings have zeros of their own, each recording that was taken away is counted
/// from where it is unloaded; the bandwidth of its accelerations is the one by which what was found
/// leaves least of it, before and after alike (bandwidths_for). Errors: those of fits.
Result<Judged> judge(Frame whole, const Eigen::ArrayXd& held, const Finding& finding);

/// Errors of these residuals on the rows marked 1, at the output, with the interval of their ratio.
/// of_motion: torque_of_motion_error() of the second.
HoldoutProof proof_on(const Frame& frame, const Eigen::ArrayXd& held, Equation equation,
                      const Eigen::ArrayXd& before, const Eigen::ArrayXd& after,
                      const Eigen::ArrayXd& of_motion);

/// The recordings of a set but for those of these ids.
/// Errors: usage, an id that the set has not, or every recording.
Result<RecordingSet> without(const RecordingSet& set, const std::vector<std::string>& ids);

/// What was found, judged on recordings that were taken away before anything was looked for.
/// Errors: of judge.
struct JudgedOnce {
  HoldoutProof proof;
  std::vector<DiagnosedSeries> series;  ///< of the recordings taken away
};
Result<JudgedOnce> judged_once(const RecordingSet& all, const std::vector<std::string>& ids,
                               const Finding& finding, Eigen::Index most_rows);

}  // namespace flexspline::studies
