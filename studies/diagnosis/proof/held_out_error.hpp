#pragma once

#include "diagnosis/model/noise.hpp"
#include "flexspline/studies/diagnosis.hpp"

namespace flexspline::studies {

/// Root mean square of a residual over the rows marked 1; NaN where there are none.
double rms_on(const Eigen::ArrayXd& residual, const Eigen::ArrayXd& rows);

/// What of an equation's residual r is noise over the rows marked 1, Nm: rms(r)/(rms(r
/// s/d)/rms(s)), s the deviation of the noise, d with that of errors of the motions, so that r over
/// it is the error over noise where each row counts as it is known. rms(s) where motions have no
/// error.
double noise_of(const Frame& frame, const EquationNoise& noise, const Eigen::ArrayXd& residual,
                const Eigen::ArrayXd& rows);

/// 95 % interval of the ratio R of two errors over the rows marked 1: of ln R, by the jackknife
/// over eighths of the recordings and Student's quantile (Miller 1974),
///   ln R -+ t sqrt((P - 1)/P sum_k (ln R_k - mean)^2),  R_k without the k-th of P eighths.
/// It holds what R would be where these recordings are repeated: same motion, other noise. Other
/// motions, and a drive that is warmer or has drifted, have another R. NaN of a single eighth.
void take_interval(const Frame& frame, const Eigen::ArrayXd& rows, const Eigen::ArrayXd& before,
                   const Eigen::ArrayXd& after, HoldoutProof& proof);

}  // namespace flexspline::studies
