#pragma once

#include "diagnosis/judged_once.hpp"

namespace flexspline::studies {

/// What the whole search finds where recordings are missing, and leaves of those.
struct NestedProof {
  HoldoutProof proof;
  std::vector<std::vector<std::string>> named;  ///< by outer fold: causes and their alternatives
};

/// The whole search, zeros, gap, incidents, choice and noise, once more in every outer fold
/// (outer_folds), on recordings from which the held-out rows are deleted; each of these is judged
/// by what was found without it, in the equation that the finding in all recordings is judged in.
/// The same for any number of threads. Errors: what makes the recordings of a fold unusable; those
/// of fits.
Result<NestedProof> nested_proof(const RecordingSet& all, const Finding& finding,
                                 const Limits& limits, Eigen::Index most_rows,
                                 const DiagnosisProgress& progress);

/// Share of the folds that name a cause or one of its alternatives.
double stability_of(const NestedProof& nested, const Cause& cause);

}  // namespace flexspline::studies
