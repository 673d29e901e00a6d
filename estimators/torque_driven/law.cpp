#include "torque_driven/law.hpp"

#include <complex>
#include <vector>

namespace flexspline::estimators {

double driven_slope(const DrivenProblem& problem, std::span<const double> p, double torque,
                    double x) {
  constexpr double kStep = 1e-100;
  const std::vector<std::complex<double>> coefficients(p.begin(), p.end());
  const std::complex<double> at(x, kStep);
  return driven_rate<std::complex<double>>(problem, coefficients, torque, at).imag() / kStep;
}

}  // namespace flexspline::estimators
