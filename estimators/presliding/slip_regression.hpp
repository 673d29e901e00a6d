#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "flexspline/core/model_spec.hpp"
#include "torsion/prepared_record.hpp"

namespace flexspline::estimators {

/// Columns of the linear model of slip: f's coefficients, the stiffness of every stop of a fixed
/// grid of yields, a linear viscous term. All in Nm (N) at the largest motion and speed.
struct SlipColumns {
  Eigen::Index f = 0;
  Eigen::Index stops = 0;
  Eigen::Index viscous = 0;
  Eigen::Index size() const { return f + stops + viscous; }
};
SlipColumns slip_columns();

/// "f[1]", "stop[3]", "viscous".
std::string slip_column_name(Eigen::Index k);

/// f of eq. (4) by its coefficients at the head of x, over the range of the motion.
LawSpec slip_stiffness_law(const Ranges& ranges, const Eigen::VectorXd& x);

/// f, the stops that are not zero and the damper as a model.
ModelSpec slip_model(const Eigen::VectorXd& x, const Ranges& ranges);

/// Regressors and measured effort, rows of all records one below the other, in standard deviations
/// of the effort's noise.
struct SlipRegression {
  Eigen::MatrixXd matrix;
  Eigen::VectorXd target;
};
Result<SlipRegression> slip_regression(const std::vector<PreparedRecord>& records,
                                       const Ranges& ranges);

}  // namespace flexspline::estimators
