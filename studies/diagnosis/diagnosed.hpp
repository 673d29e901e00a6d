#pragma once

#include "diagnosis/decision.hpp"

namespace flexspline::studies {

/// A diagnosis by other limits than the usual ones, from the sanity of the recordings to the words:
/// what each rule buys is measured so (docs/decisions/0024). Errors: those of diagnose.
Result<Diagnosis> diagnosed(const RecordingSet& recordings, const DiagnosisProgress& progress,
                            const DiagnosisSettings& settings, Limits limits);

}  // namespace flexspline::studies
