#pragma once

#include "diagnosis/model/model.hpp"

namespace flexspline::studies {

/// The sign with which the motor's dry friction turns with its speed w, all rows: a mixture
///   s = sum_k c_k tanh(w/w_k), c_k >= 0, sum c_k = 1, w_k the baseline's dry_widths:
/// with DriveModel::sign_shares, else with those of the baseline's dry friction; where it has
/// none, one hundredth of the largest speed.
Eigen::ArrayXd motor_sign(const Frame& frame, const DriveModel& model);

/// Shares c_k, up to a factor, of the sign by which the fitted model, its magnitudes of dry
/// friction as they stand, those of causes and the baseline's own together, comes nearest to the
/// measured torque. One step of a descent over signs and magnitudes in turn; the shares of the
/// baseline's part alone are no such step: where causes have more of the friction they make up for
/// the sign that these had. Empty where no cause turns with that sign.
/// Not modelled: a cause of the square of s is taken as the same mixture of squares.
Eigen::VectorXd fitted_sign(const Frame& frame, const ModelFit& fit, const Reference& reference,
                            const Eigen::ArrayXd& weight);

}  // namespace flexspline::studies
