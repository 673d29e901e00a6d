#pragma once

#include "diagnosis/proof/prove.hpp"
#include "diagnosis/unnamed/resonance.hpp"
#include "diagnosis/unnamed/ripple_finding.hpp"
#include "flexspline/studies/diagnosis.hpp"

namespace flexspline::studies {

/// Probability that noise alone gains that much by so many parameters, 1e-12 at least.
double p_value(double chi_square, int parameters);

/// Of a cause that is in the model and too small to be named: by what.
std::string how_small(const Trial& trial, const Limits& limits);

/// The parts of a diagnosis that a person reads, from the numbers of the search.
std::string baseline_in_words(const Frame& frame);
/// What recordings asked of the baseline beyond that.
std::vector<std::string> spelled_parts(const Frame& frame, const Selection& selection);
std::vector<Cause> spelled_causes(const Frame& frame, const Selection& selection,
                                  const Proof& proof);
/// Incidents, coordinates of the causes, a resonance, then those of the scan by strength, each with
/// the window where it is largest.
std::vector<Mismatch> spelled_mismatch(const Frame& frame, const Selection& selection,
                                       const Limits& limits,
                                       const std::optional<Resonance>& resonance);
/// A ripple over the motor's angle: a note; its coordinate and its name where no cause took it.
void spell_ripple(const Frame& frame, const Selection& selection, const RippleFinding& finding,
                  Diagnosis& diagnosis);
/// |cosine| between what the causes of the first round change in the prediction.
std::vector<Confusable> spelled_confusable(const Frame& frame, const Selection& selection);
std::vector<TriedCandidate> spelled_trials(const Selection& selection, const Limits& limits);
std::vector<ParameterMove> spelled_moves(const Frame& frame, const Selection& selection);
std::string spelled_verdict(const Selection& selection, const Limits& limits,
                            const std::optional<Resonance>& resonance, const Diagnosis& diagnosis);

}  // namespace flexspline::studies
