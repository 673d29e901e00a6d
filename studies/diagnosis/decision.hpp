#pragma once

#include <optional>
#include <vector>

#include "diagnosis/names/nested_proof.hpp"
#include "diagnosis/names/undecided.hpp"
#include "diagnosis/unnamed/resonance.hpp"
#include "diagnosis/unnamed/ripple_finding.hpp"
#include "diagnosis/unnamed/unnamed.hpp"

namespace flexspline::studies {

/// What a diagnosis decides, before it is put into words.
struct Decision {
  Finding finding;                      ///< of all recordings that were searched
  std::optional<RippleFinding> ripple;  ///< in the fast changes, which the search counts as noise
  std::optional<Resonance> resonance;   ///< that the model lacks, unless a table follows it better
  HoldoutProof proof;                   ///< of recordings that the search had not
  std::optional<HoldoutProof> cross_validated;  ///< of the recordings searched, where proof is not
  std::optional<NestedProof> nested;            ///< by outer fold
  std::vector<DiagnosedSeries> taken_away;      ///< recordings that were judged once
  Verdict verdict = Verdict::undecided;
  std::optional<UnnamedPart> unnamed;    ///< of what is left
  std::optional<Undecidable> undecided;  ///< why no verdict stands
  std::vector<std::string> notes;
};

/// Noise, baseline, discrepancy, names and their proof, in this order, then the verdict: the steps
/// of docs/diagnosis.md. Errors: recordings that are not usable (data), an id of settings.holdout
/// that does not exist (usage), numerics.
Result<Decision> decide(const RecordingSet& recordings, const DiagnosisSettings& settings,
                        const Limits& limits, const DiagnosisProgress& progress);

}  // namespace flexspline::studies
