#pragma once

#include <functional>
#include <vector>

#include <Eigen/Core>

#include "diagnosis/model/counterpart.hpp"
#include "diagnosis/model/model.hpp"
#include "flexspline/core/model_spec.hpp"

namespace flexspline::studies {

/// A law put into a class of the catalogue, and its largest error over its largest value.
struct FittedLaw {
  LawSpec law;
  double error = 0.0;
};

/// The b >= 0 with the smallest ||columns b - target||.
Eigen::VectorXd nonnegative_fit(const Eigen::MatrixXd& columns, const Eigen::VectorXd& target);

/// f of the baseline with these own coefficients, of torsions from its zero; Nm.
Eigen::ArrayXd elastic_torque(const Frame& seen, const Eigen::VectorXd& own,
                              const Eigen::ArrayXd& torsion);

/// f of a gear over the torsion up to a range, as an odd monotone spline; sees: what of the torsion
/// it gets, empty for all.
FittedLaw elastic_law(const Frame& seen, const Eigen::VectorXd& own, double range,
                      const std::function<double(double)>& sees);

/// h = exp(c1 x^2 + c2 x^4) of what is seen of the torsion, by least squares of ln h.
LawSpec modulation_law(const Frame& seen, std::span<const double> shape, double range,
                       const std::function<double(double)>& sees);

/// g^-1 of a gear over phi'/h.
FittedLaw dissipative_law(const Frame& seen, const Eigen::VectorXd& own);

/// The motor's dry friction over its largest value, by the speeds over which it saturates.
std::vector<SignPart> sign_parts(const Frame& seen, const Eigen::ArrayXd& motor_sign);

}  // namespace flexspline::studies
