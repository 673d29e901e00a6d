#pragma once

#include <cmath>
#include <span>

#include "torque_driven/series.hpp"

namespace flexspline::estimators {

/// phi' = h(phi) g(tau - f(phi)) in scaled units, written once for every scalar: what the kernels
/// are held against.
template <class S>
S driven_rate(const DrivenProblem& problem, std::span<const S> p, double torque, const S& x) {
  using std::exp;
  const auto polynomial = [&p](int first, int terms, const S& square) {
    S sum(0.0);
    for (int k = first + terms; k-- > first;)
      sum = S(S(sum * square) + p[static_cast<std::size_t>(k)]);
    return sum;
  };
  const S x2(x * x);
  const S u(torque - S(polynomial(0, problem.f, x2) * x));
  const S u2(u * u);
  const S speed(polynomial(problem.f, problem.g, u2) * u);
  const S ln_h(polynomial(problem.f + problem.g, problem.h, x2) * x2);
  return S(S(exp(ln_h)) * speed);
}

/// d phi'/d phi.
double driven_slope(const DrivenProblem& problem, std::span<const double> p, double torque,
                    double x);

}  // namespace flexspline::estimators
