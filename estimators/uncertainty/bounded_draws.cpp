#include "uncertainty/bounded_draws.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include <Eigen/Dense>
#include <boost/math/special_functions/erf.hpp>

namespace flexspline::estimators {
namespace {

constexpr int kSettle = 200;  // sweeps before the first draw
constexpr int kBetween = 3;   // from one draw to the next
constexpr double kFar = 5.0;  // standard deviations beyond which a tail is drawn exponentially

// Share of the standard normal beyond z.
double beyond(double z) { return 0.5 * std::erfc(z / std::numbers::sqrt2); }

double from_beyond(double share) {
  return std::numbers::sqrt2 * boost::math::erfc_inv(2.0 * share);
}

// Standard normal within [low, high], low >= 0 far out in the tail (Robert 1995).
double tail(double low, double high, std::mt19937_64& engine) {
  std::uniform_real_distribution<double> uniform(std::numeric_limits<double>::min(), 1.0);
  for (;;) {
    const double z = low - std::log(uniform(engine)) / low;
    if (z <= high && std::log(uniform(engine)) <= -0.5 * (z - low) * (z - low)) return z;
    if (high - low < 1.0 / low) return low + (high - low) * uniform(engine);
  }
}

double standard_within(double low, double high, std::mt19937_64& engine) {
  if (low > kFar) return tail(low, high, engine);
  if (high < -kFar) return -tail(-high, -low, engine);
  const double from = beyond(high);
  const double to = beyond(low);
  std::uniform_real_distribution<double> uniform(from, to);
  const double share = std::clamp(uniform(engine), 1e-300, 1.0 - 1e-16);
  return std::clamp(from_beyond(share), low, high);
}

// Those that have a variance: what recordings say nothing of stays where it is.
std::vector<Eigen::Index> varying(const BoundedNormal& law) {
  std::vector<Eigen::Index> list;
  for (Eigen::Index k = 0; k < law.mean.size(); ++k) {
    if (law.covariance(k, k) > 0.0) list.push_back(k);
  }
  return list;
}

}  // namespace

Eigen::MatrixXd draws_of(const BoundedNormal& law, Eigen::VectorXd start, Eigen::Index count,
                         std::uint64_t seed) {
  const auto which = varying(law);
  const auto size = static_cast<Eigen::Index>(which.size());
  const Eigen::VectorXd mean = law.mean(which);
  const Eigen::MatrixXd covariance = law.covariance(which, which);
  const Eigen::VectorXd scale = covariance.diagonal().cwiseSqrt();
  const Eigen::MatrixXd correlation =
      scale.cwiseInverse().asDiagonal() * covariance * scale.cwiseInverse().asDiagonal();
  const Eigen::MatrixXd precision = correlation.ldlt().solve(Eigen::MatrixXd::Identity(size, size));
  if (!(precision.diagonal().array() > 0.0).all()) return {};
  const Eigen::VectorXd lower = (law.lower(which) - mean).cwiseQuotient(scale);
  const Eigen::VectorXd upper = (law.upper(which) - mean).cwiseQuotient(scale);
  Eigen::VectorXd x = (start(which) - mean).cwiseQuotient(scale);
  std::mt19937_64 engine(seed);
  Eigen::MatrixXd draws(count, law.mean.size());
  for (Eigen::Index sweep = 0; sweep < kSettle + kBetween * count; ++sweep) {
    for (Eigen::Index k = 0; k < size; ++k) {
      const double own = precision(k, k);
      const double centre = x[k] - precision.row(k).dot(x) / own;
      const double spread = 1.0 / std::sqrt(own);
      x[k] = centre + spread * standard_within((lower[k] - centre) / spread,
                                               (upper[k] - centre) / spread, engine);
    }
    const Eigen::Index since = sweep - kSettle;
    if (since >= 0 && since % kBetween == 0) {
      start(which) = mean + x.cwiseProduct(scale);
      draws.row(since / kBetween) = start.transpose();
    }
  }
  return draws;
}

}  // namespace flexspline::estimators
