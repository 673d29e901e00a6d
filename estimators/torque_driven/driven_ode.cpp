#include "torque_driven/driven_ode.hpp"

#include <algorithm>
#include <cmath>

namespace flexspline::estimators {

double DrivenOde::torque(double t) const {
  const auto& time = series_.time;
  const std::size_t last = series_.intervals() - 1;
  while (interval_ < last && t > time[interval_ + 1]) ++interval_;
  while (interval_ > 0 && t < time[interval_]) --interval_;
  const double share = (t - time[interval_]) / series_.width(interval_);
  return series_.torque_at(interval_, std::clamp(share, 0.0, 1.0));
}

void DrivenOde::evaluate(double t, double x) const {
  if (t == t_ && x == x_) return;
  const auto polynomial = [this](int first, int terms, double square, auto factor) {
    double sum = 0.0;
    for (int k = terms; k-- > 0;) {
      sum = sum * square + factor(k) * p_[static_cast<std::size_t>(first + k)];
    }
    return sum;
  };
  const auto one = [](int) { return 1.0; };
  const auto odd = [](int k) { return 2.0 * k + 1.0; };
  const auto even = [](int k) { return 2.0 * k + 2.0; };
  const int f = problem_.f;
  const int g = problem_.g;
  const double x2 = x * x;
  const double u = torque(t) - polynomial(0, f, x2, one) * x;
  u2_ = u * u;
  const double modulation = std::exp(polynomial(f + g, problem_.h, x2, one) * x2);
  damping_ = modulation * u;
  rate_ = damping_ * polynomial(f, g, u2_, one);
  const double stiffness = modulation * polynomial(f, g, u2_, odd);
  slope_ =
      rate_ * polynomial(f + g, problem_.h, x2, even) * x - stiffness * polynomial(0, f, x2, odd);
  spring_ = -stiffness * x;
  t_ = t;
  x_ = x;
}

double DrivenOde::rate(double t, double x) const {
  evaluate(t, x);
  return rate_;
}

double DrivenOde::jacobian(double t, double x) const {
  evaluate(t, x);
  return slope_;
}

double DrivenOde::parameter_derivative(double t, double x, std::span<double> out) const {
  evaluate(t, x);
  auto at = out.begin();
  const auto fill = [&at](int terms, double value, double square) {
    for (int k = 0; k < terms; ++k, value *= square) *at++ = value;
  };
  fill(problem_.f, spring_, x * x);
  fill(problem_.g, damping_, u2_);
  fill(problem_.h, rate_ * x * x, x * x);
  return slope_;
}

}  // namespace flexspline::estimators
