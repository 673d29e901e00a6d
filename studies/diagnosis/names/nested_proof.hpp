#pragma once

#include "diagnosis/names/judged_once.hpp"

namespace flexspline::studies {

/// A cause in the model of a search, named or not.
struct FoundCause {
  std::vector<std::string> ids;  ///< its own and its alternatives'
  double probability = 0.0;      ///< that one of these names is right
  bool named = false;
};

/// What the whole search finds without one outer fold, and leaves of it where the fold proves.
struct SearchedFold {
  Eigen::ArrayXd held;        ///< 1 in each usable row of the fold
  PerEquation before, after;  ///< residuals of the baseline and of what was found
  PerEquation of_motion;      ///< torque_of_motion_error() of what was found
  std::vector<FoundCause> found;
};

/// The searches without each outer fold.
struct FoldSearches {
  std::vector<Result<SearchedFold>> proving;    ///< one a fold that is judged
  std::vector<std::vector<FoundCause>> others;  ///< without each other fold that can be missed
};

/// The search in all recordings, and those without each outer fold.
struct Searches {
  Result<Finding> finding = failure(ErrorCode::numerics, "nothing was searched");
  FoldSearches folds;
};

/// The search in `whole`, the frame of all recordings; where nested the whole search, zeros, gap,
/// incidents, choice and noise, once more without every outer fold (outer_folds): in recordings
/// from which its rows are deleted, each of which is judged by what was found without it. Two at a
/// time; the same for any number of threads. Errors of a fold: what makes its recordings unusable;
/// those of fits.
Searches search_all(const RecordingSet& all, const Frame& whole, bool nested, const Limits& limits,
                    Eigen::Index most_rows, const DiagnosisProgress& progress);

/// Takes the errors of the whole search on rows that it did not have as evidence of names
/// (NameEvidence), in place of those of causes that were chosen with these rows in view, and what
/// the folds' own searches say of these names. Where a fold lacks one of a cause's equations its
/// evidence stays; where a fold failed all does.
void judge_by_folds(const Frame& whole, const FoldSearches& searched, Finding& finding);

/// What the folds prove together.
struct NestedProof {
  HoldoutProof proof;
  std::vector<std::vector<FoundCause>> found;  ///< without each outer fold
};

/// In one equation. Errors: those of the folds; numerics, where one of them has no such equation.
Result<NestedProof> nested_proof(const Frame& whole, const FoldSearches& searched,
                                 Equation equation);

/// Share of the folds that name a cause or one of its alternatives.
double stability_of(const NestedProof& nested, const Cause& cause);

}  // namespace flexspline::studies
