#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <Eigen/Dense>

#include "flexspline/core/law.hpp"
#include "midpoint/polynomial_estimate.hpp"
#include "uncertainty/bands.hpp"
#include "uncertainty/covariance.hpp"
#include "uncertainty/identifiability.hpp"

namespace flexspline::estimators {
namespace {

constexpr Eigen::Index kTerms = 5;
constexpr double kNormal95 = 1.959963984540054;
constexpr double kDegrees = 180.0 / std::numbers::pi;

struct Polynomial {
  LawSpec law;
  Eigen::MatrixXd covariance;
  double residual_squares = 0.0;
  double condition = 0.0;
};

// Odd powers of x / scale, a row an argument.
Eigen::MatrixXd odd_powers(const std::vector<double>& x, double scale) {
  Eigen::MatrixXd powers(static_cast<Eigen::Index>(x.size()), kTerms);
  for (Eigen::Index i = 0; i < powers.rows(); ++i) {
    const double u = x[static_cast<std::size_t>(i)] / scale;
    for (Eigen::Index k = 0; k < kTerms; ++k)
      powers(i, k) = std::pow(u, 2.0 * static_cast<double>(k) + 1.0);
  }
  return powers;
}

double largest(const std::vector<double>& x) {
  double most = 0.0;
  for (double value : x) most = std::max(most, std::abs(value));
  return most;
}

// y = [p(a) + p(b)] / 2, a polynomial over the larger of the two ranges.
Polynomial fit_polynomial(const std::vector<double>& a, const std::vector<double>& b,
                          const std::vector<double>& y) {
  const auto n = static_cast<Eigen::Index>(y.size());
  const double scale = std::max(largest(a), largest(b));
  const Eigen::MatrixXd powers = 0.5 * (odd_powers(a, scale) + odd_powers(b, scale));
  const Eigen::Map<const Eigen::VectorXd> target(y.data(), n);
  const Eigen::VectorXd c = powers.colPivHouseholderQr().solve(target);
  Polynomial result;
  result.law = {.law = "odd_polynomial",
                .scale = scale,
                .knots = {},
                .coefficients = std::vector<double>(c.data(), c.data() + kTerms),
                .valid_to = scale};
  const Eigen::VectorXd residual = target - powers * c;
  result.residual_squares = residual.squaredNorm();
  // Neighbours on the locus share samples and coloured noise.
  const double colour = long_run_ratio({residual.data(), static_cast<std::size_t>(n)});
  const double variance =
      std::max(1.0, colour) * result.residual_squares / static_cast<double>(n - kTerms);
  result.covariance = variance * (powers.transpose() * powers).inverse();
  result.condition = scaled_condition(powers);
  return result;
}

// Coefficients in the units of Table I: Nm/deg^p of the angle (Nm/(deg/s)^p of its rate).
void add_parameters(const Polynomial& polynomial, char letter, bool rate, bool linear,
                    std::vector<ParameterEstimate>& list) {
  const double scale = polynomial.law.scale * (linear ? 1.0 : kDegrees);
  for (Eigen::Index k = 0; k < kTerms; ++k) {
    const int power = static_cast<int>(2 * k + 1);
    const double factor = std::pow(scale, -power);
    ParameterEstimate one;
    one.name = fmt::format("{}{}", letter, k + 1);
    const std::string base = fmt::format("{}{}", linear ? "m" : "deg", rate ? "/s" : "");
    one.unit = fmt::format("{}/{}{}", linear ? "N" : "Nm", rate ? "(" + base + ")" : base,
                           power == 1 ? "" : fmt::format("^{}", power));
    one.value = polynomial.law.coefficients[static_cast<std::size_t>(k)] * factor;
    one.std = std::sqrt(polynomial.covariance(k, k)) * factor;
    one.ci95_lower = one.value - kNormal95 * one.std;
    one.ci95_upper = one.value + kNormal95 * one.std;
    list.push_back(std::move(one));
  }
}

// Share of the fitted range up to which the polynomial increases; 2 where it does so beyond twice.
double monotone_share(const Law& law) {
  for (double u = 0.0; u <= 2.0; u += 0.001) {
    if (law.slope(u * law.spec().scale) <= 0.0) return u;
  }
  return 2.0;
}

std::string monotone_note(std::string_view name, const Law& law) {
  const double share = monotone_share(law);
  if (share >= 2.0) return fmt::format("{} increases beyond twice its fitted range", name);
  return fmt::format(
      "{} increases up to {:.1f} % of its fitted range and falls beyond: outside it "
      "the model can make energy",
      name, 100.0 * share);
}

std::vector<double> joined(const std::vector<MidpointLocus>& loci,
                           std::vector<double> MidpointLocus::*member) {
  std::vector<double> all;
  for (const auto& locus : loci) {
    all.insert(all.end(), (locus.*member).begin(), (locus.*member).end());
  }
  return all;
}

}  // namespace

OptionInfo locus_speed_option() {
  return {.name = "speed",
          .meaning =
              "speed on the locus: that of the sine fitted to the motion, as in the paper, "
              "or the derivative of the measured motion, averaged over its cycles",
          .choices = {"pure_sine", "measured"}};
}

LocusSpeed locus_speed(const FitProblem& problem, const MethodRow& method) {
  return word(problem, method, "speed") == "measured" ? LocusSpeed::measured
                                                      : LocusSpeed::pure_sine;
}

Estimate polynomial_estimate(std::string estimator, const std::vector<MidpointLocus>& loci,
                             const std::vector<TorsionRecord>& records) {
  const auto motion = joined(loci, &MidpointLocus::motion);
  const auto rising = joined(loci, &MidpointLocus::rising_rate);
  const auto falling = joined(loci, &MidpointLocus::falling_rate);
  auto midpoint = joined(loci, &MidpointLocus::midpoint);
  const Polynomial g = fit_polynomial(rising, falling, joined(loci, &MidpointLocus::distance));
  const auto g_law = make_law(g.law);
  expects(g_law.has_value(), "a polynomial can be made");
  for (std::size_t i = 0; i < midpoint.size(); ++i) {
    midpoint[i] -= 0.5 * ((*g_law)->value(rising[i]) - (*g_law)->value(falling[i]));
  }
  const Polynomial f = fit_polynomial(motion, motion, midpoint);
  const double purity = std::ranges::min(loci, {}, &MidpointLocus::purity).purity;
  const bool linear = records.front().linear;

  Estimate estimate;
  estimate.estimator = std::move(estimator);
  estimate.model = {
      .f = f.law,
      .g_inverse = g.law,
      .h = {.law = "bounded_modulation", .scale = f.law.scale, .knots = {}, .coefficients = {}},
      .effects = {}};
  add_parameters(f, 'a', false, linear, estimate.parameters);
  add_parameters(g, 'b', true, linear, estimate.parameters);
  for (std::size_t k = 0; k < loci.size(); ++k) {
    if (std::abs(loci[k].centre) < 0.05 * loci[k].amplitude) continue;
    ParameterEstimate zero;
    zero.name = fmt::format("zero[{}]", records[k].id);
    zero.value = loci[k].centre;
    zero.unit = linear ? "m" : "rad";
    estimate.parameters.push_back(std::move(zero));
  }
  estimate.termination = Termination::converged;
  estimate.cost = 0.5 * (f.residual_squares + g.residual_squares);
  estimate.residual = "Xm - f and Xd - g^-1 on the midpoint locus, eqs. (22), (23), in Nm (N)";
  const double points = static_cast<double>(midpoint.size());
  for (const auto& record : records) {
    estimate.fits.push_back(
        {record.id, Split::train, std::sqrt((f.residual_squares + g.residual_squares) / points)});
  }
  estimate.identifiability = {
      .condition = std::max(f.condition, g.condition),
      .absorbed = {},
      .verdict = "not_identifiable",
      .says = "the method assumes h = 1; what h does to the loop goes into g^-1 unseen"};
  const auto f_law = make_law(f.law);
  expects(f_law.has_value(), "a polynomial can be made");
  estimate.bands.push_back(law_band("f", **f_law, f.covariance, -f.law.scale, f.law.scale));
  estimate.bands.push_back(law_band("g_inverse", **g_law, g.covariance, -g.law.scale, g.law.scale));
  estimate.notes = {monotone_note("f", **f_law), monotone_note("g^-1", **g_law),
                    fmt::format("a pure sine explains {:.3f} % of the motion", 100.0 * purity)};
  estimate.evaluations = 1;
  return estimate;
}

}  // namespace flexspline::estimators
