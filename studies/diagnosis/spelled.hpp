#pragma once

#include "diagnosis/prove.hpp"
#include "flexspline/studies/diagnosis.hpp"

namespace flexspline::studies {

/// The parts of a diagnosis that a person reads, from the numbers of the search.
std::string baseline_in_words(const Frame& frame);
std::vector<Cause> spelled_causes(const Frame& frame, const Selection& selection,
                                  const Proof& proof);
/// Coordinates of the causes first, then those of the scan by strength, each with the window where
/// it is largest.
std::vector<Mismatch> spelled_mismatch(const Frame& frame, const Selection& selection,
                                       const Limits& limits);
/// |cosine| between what the causes of the first round change in the prediction.
std::vector<Confusable> spelled_confusable(const Frame& frame, const Selection& selection);
std::vector<TriedCandidate> spelled_trials(const Selection& selection, const Limits& limits);
std::vector<ParameterMove> spelled_moves(const Frame& frame, const Selection& selection);
/// Recordings as measured and as predicted, those held out by fits that did not see them.
std::vector<DiagnosedSeries> spelled_series(const Frame& frame, const Selection& selection,
                                            const Proof& proof);
std::string spelled_verdict(const Selection& selection, const Limits& limits,
                            const Diagnosis& diagnosis);

}  // namespace flexspline::studies
