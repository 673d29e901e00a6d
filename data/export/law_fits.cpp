#include "export/law_fits.hpp"

#include <cmath>

#include <Eigen/Core>

#include "bench/nonnegative_least_squares.hpp"
#include "export/c_law.hpp"

namespace flexspline::data {
namespace {

constexpr int kPoints = 400;

/// Coefficients over powers of u = x/domain, fitted to the mean of both sides.
Result<Eigen::VectorXd> powers_of(const LawSpec& spec, const std::vector<int>& powers) {
  const auto law = make_law(spec);
  if (!law) return tl::unexpected(law.error());
  const double domain = domain_of(spec);
  Eigen::MatrixXd columns(kPoints, static_cast<Eigen::Index>(powers.size()));
  Eigen::VectorXd target(kPoints);
  for (int i = 0; i < kPoints; ++i) {
    const double u = (i + 1.0) / kPoints;
    for (std::size_t k = 0; k < powers.size(); ++k) {
      columns(i, static_cast<Eigen::Index>(k)) = std::pow(u, powers[k]);
    }
    target[i] = 0.5 * ((*law)->value(u * domain) - (*law)->value(-u * domain));
  }
  return nonnegative_least_squares(columns, target);
}

}  // namespace

double domain_of(const LawSpec& law) {
  if (law.valid_to > 0.0) return law.valid_to;
  if (law.law == "free_spline") {
    return law.scale * std::max(std::abs(law.knots[0]), std::abs(law.knots[1]));
  }
  return law.scale;
}

Result<LawSpec> cubic_spring(const LawSpec& law) {
  if (law.law == "odd_polynomial" && law.coefficients.size() <= 2) return law;
  const auto c = powers_of(law, {1, 3});
  if (!c) return tl::unexpected(c.error());
  return LawSpec{"odd_polynomial", domain_of(law), {}, {(*c)[0], (*c)[1]}, law.valid_to};
}

// y' = c0 + 2 c1 u + 3 c2 u^2 in quadratic B-splines without knots (Bernstein polynomials).
Result<LawSpec> cubic_damper(const LawSpec& law) {
  if (law == rigid_law()) return law;
  const auto c = powers_of(law, {1, 2, 3});
  if (!c) return tl::unexpected(c.error());
  const double a = (*c)[0];
  const double b = 2.0 * (*c)[1];
  const double d = 3.0 * (*c)[2];
  return LawSpec{"monotone_spline", domain_of(law), {}, {a, a + 0.5 * b, a + b + d}, law.valid_to};
}

std::array<double, 3> polynomial_of(const LawSpec& spec) {
  const double s = spec.scale;
  if (spec.law == "odd_polynomial") {
    const double c = spec.coefficients.size() > 1 ? spec.coefficients[1] : 0.0;
    return {spec.coefficients[0] / s, 0.0, c / (s * s * s)};
  }
  const double a = spec.coefficients[0];
  const double b = 2.0 * (spec.coefficients[1] - a);
  const double d = spec.coefficients[2] - a - b;
  return {a / s, 0.5 * b / (s * s), d / 3.0 / (s * s * s)};
}

}  // namespace flexspline::data
