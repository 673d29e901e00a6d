#pragma once

#include "flexspline/studies/diagnosis.hpp"

namespace flexspline::studies {

/// What may be set of a decision by evidence.
struct EvidenceSettings {
  double interest = 0.008;  ///< floor of interest: share of the largest torque below which nothing
                            ///< is named, and a remainder is no finding
  unsigned threads = 0;     ///< 0: as many as the machine has
  bool proves = true;       ///< by outer folds; without, there is no held-out error
  bool model = true;        ///< the fitted model by the catalogue of effects
};

/// What diagnose() answers, decided by one principle: baseline, causes and a discrepancy of low
/// rank are one linear mixed model of each equation with autoregressive noise, and what is named,
/// what is left and what is located follow from its marginal likelihood (docs/decisions/0014). The
/// whole decision runs again in every outer fold, on recordings from which the held-out rows are
/// deleted. The result does not depend on the number of threads. Errors: recordings that are not
/// usable (data), numerics.
Result<Diagnosis> diagnose_by_evidence(const RecordingSet& recordings,
                                       const DiagnosisProgress& progress = {},
                                       const EvidenceSettings& settings = {});

}  // namespace flexspline::studies
