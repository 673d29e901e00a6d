#pragma once

#include <functional>

#include "flexspline/core/twice_ode_system.hpp"
#include "flexspline/estimators/ode_inequalities.hpp"

namespace flexspline::estimators {

/// Sizes and numbers of terms of a torsion law in polynomials.
struct PolynomialTorsionShape {
  double motion = 1.0;  ///< rad (m), > 0; f and h are polynomials in x = phi / motion
  double effort = 1.0;  ///< Nm (N), > 0; g is one in z = (tau - f) / effort
  double speed = 1.0;   ///< rad/s (m/s), > 0
  std::size_t f = 2;
  std::size_t g = 2;
  std::size_t h = 1;

  std::size_t parameters() const { return f + g + h; }
};

/// Torque-driven, eq. (3) of Dhaouadi and Ghorbel (2003), phi' = h(phi) g(tau(t) - f(phi)), with
/// f = effort (f1 x + f2 x^3 + ...), g = speed (g1 z + g2 z^3 + ...), ln h = h1 x^2 + h2 x^4 + ...
/// Parameters: f, then g, then h, all without unit. Recordings follow each other in time, each an
/// experiment with its own start_time. Not modelled: odd terms of ln h, inertia, an offset.
class PolynomialTorsion final : public OdeLaw<PolynomialTorsion> {
 public:
  PolynomialTorsion(PolynomialTorsionShape shape, std::function<double(double)> effort)
      : shape_(shape), effort_(std::move(effort)) {}

  std::size_t states() const override { return 1; }
  std::size_t parameters() const override { return shape_.parameters(); }

  template <class S>
  void law(double t, std::span<const S> y, std::span<const S> p, std::span<S> ydot) const {
    using std::exp;
    const S x = S(y[0] / S(shape_.motion));
    const S f = odd(p.first(shape_.f), x);
    const S z = S(S(effort_(t) / shape_.effort) - f);
    const S g = odd(p.subspan(shape_.f, shape_.g), z);
    const S log_h = even(p.subspan(shape_.f + shape_.g), x);
    ydot[0] = S(S(S(shape_.speed) * g) * S(exp(log_h)));
  }

  /// c1 x + c2 x^3 + ...
  template <class S>
  static S odd(std::span<const S> c, const S& x) {
    S sum(0.0);
    const S square = S(x * x);
    for (std::size_t k = c.size(); k-- > 0;) sum = S(S(sum * square) + c[k]);
    return S(sum * x);
  }
  /// c1 x^2 + c2 x^4 + ...
  template <class S>
  static S even(std::span<const S> c, const S& x) {
    return c.empty() ? S(0.0) : S(odd(c, x) * x);
  }

 private:
  PolynomialTorsionShape shape_;
  std::function<double(double)> effort_;
};

/// f' >= slope and g' >= slope (in f1 and g1), lowest <= h <= highest at even points from 0 to 1 of
/// x and z. What the fitted polynomials do between the points, `between` proves after the fit.
class PolynomialTorsionLimits final : public OdeInequalityLaw<PolynomialTorsionLimits> {
 public:
  struct Limits {
    double slope = 1e-3;
    double lowest_h = 0.1;
    double highest_h = 10.0;
    std::size_t points = 21;
  };
  PolynomialTorsionLimits(PolynomialTorsionShape shape, Limits limits)
      : shape_(shape), limits_(limits) {}

  std::size_t count() const override { return groups() * limits_.points; }
  std::string name(std::size_t i) const override;
  double lower(std::size_t i) const override;
  double upper(std::size_t i) const override;
  /// The least of f' and g' and the extremes of h over 0 to 1, within 1e-9 by Bernstein's bounds.
  std::vector<std::string> between(std::span<const double> p) const override;

  template <class S>
  void functions(std::span<const S> p, std::span<S> values) const {
    for (std::size_t i = 0; i < limits_.points; ++i) {
      const S x(at(i));
      values[i] = slope(p.first(shape_.f), x);
      values[limits_.points + i] = slope(p.subspan(shape_.f, shape_.g), x);
      if (shape_.h == 0) continue;
      values[2 * limits_.points + i] = PolynomialTorsion::even(p.subspan(shape_.f + shape_.g), x);
    }
  }

 private:
  std::size_t groups() const { return shape_.h > 0 ? 3 : 2; }
  double at(std::size_t i) const {
    return static_cast<double>(i) / static_cast<double>(limits_.points - 1);
  }
  template <class S>
  static S slope(std::span<const S> c, const S& x) {
    S sum(0.0);
    const S square = S(x * x);
    for (std::size_t k = c.size(); k-- > 0;) {
      sum = S(S(sum * square) + S(S(2.0 * static_cast<double>(k) + 1.0) * c[k]));
    }
    return sum;
  }

  PolynomialTorsionShape shape_;
  Limits limits_;
};

}  // namespace flexspline::estimators
