#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "diagnosis/frame/frame.hpp"

namespace flexspline::studies {

/// Of a firm spring, over its mean slope.
inline constexpr double kLeastSlope = 0.6;

/// Columns of the baseline's linear parameters in one equation, and their lower bounds.
struct BaselineColumns {
  Eigen::MatrixXd columns;
  Eigen::VectorXd lower;
  Eigen::Index elastic = 0;      ///< the first columns: f; of the motor: viscous friction
  Eigen::Index dissipative = 0;  ///< the next: g^-1; of the motor: dry friction
  /// Rows whose product with the parameters is of unit variance before anything is measured: a
  /// slope of a law changes from one knot to the next by as much as the largest torque would rise
  /// over the range, and at a rate over that rate. Where no row tells, a law goes on as it came.
  Eigen::MatrixXd prior;
};

/// What the equation's own output is, measured: tau, tau - J2 theta_l'', tau_m - J1 theta_m'' -
/// tau/N; on a servo what drives it.
Eigen::ArrayXd target_of(const Frame& frame, Equation equation);

BaselineColumns baseline_columns(const Frame& frame, Equation equation,
                                 std::span<const double> shape);

/// Of the torsion equation baseline_columns() times linear parameters b, without the columns.
struct BaselineTorque {
  Eigen::ArrayXd elastic, dissipative;  ///< f and g^-1, by row
  double offset = 0.0;                  ///< of a specimen's torque
  Eigen::VectorXd prior;                ///< the rows of the prior times b
  Eigen::ArrayXd drag = {};             ///< of a load whose inertia tells the torque; or empty

  Eigen::ArrayXd sum() const {
    if (drag.size() == 0) return elastic + dissipative + offset;
    return elastic + dissipative + drag;
  }
};
BaselineTorque baseline_torque(const Frame& frame, std::span<const double> shape,
                               const Eigen::VectorXd& b);

/// The transmitted torque as far as the torsion and its rate tell it, Nm by row: its least squares
/// over usable rows on the columns of the torsion equation's baseline (h = 1, zero as it is),
/// without their bounds; hysteresis that remembers its way is not in it. Free of the sensor's
/// noise, of any colour, which smoothing keeps in part.
Eigen::ArrayXd told_torque(const Frame& frame);

/// What baseline_columns() looks at, of some rows alone. Not for a torque behind a filter, which
/// takes every row.
Frame motion_at(const Frame& frame, const std::vector<Eigen::Index>& rows);

/// Rows of a prior of baseline_columns().
Eigen::Index prior_rows(const Frame& frame, Equation equation);

/// Widths of the tanh that a dry friction is a mixture of, in the order of its columns: of the
/// motor over its speed, of an angle that travels over the torsion's rate. From a thousandth of the
/// largest speed to a half of it, two to an octave; unit of the speed.
std::vector<double> dry_widths(double largest);

}  // namespace flexspline::studies
