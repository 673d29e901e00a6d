#include "uncertainty/coloured_noise.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Dense>
#include <boost/math/tools/minima.hpp>

namespace flexspline::estimators {
namespace {

constexpr double kMostShare = 0.999;  // some white noise keeps the filter regular
constexpr int kTimes = 16;            // of the first search
constexpr int kShares = 10;
constexpr double kRidge = 1e-12;  // of the information, where no series tells a parameter
constexpr int kBits = 30;         // of ln sigma
constexpr double kHopeful = 0.5;  // of what a colour has to gain, at a point of the first search
constexpr double kSameInterval = 1e-9;  // relative: times are written with finitely many digits
constexpr double kFinest = 1e-7;        // last step of the search, in ln time and share

struct Spread {
  double shortest = std::numeric_limits<double>::infinity();
  double longest = 0.0;
  std::size_t count = 0;
};

Spread spread_of(std::span<const TimedSeries> series) {
  Spread spread;
  for (const auto& one : series) {
    spread.count += one.time.size();
    if (one.time.size() < 2) continue;
    spread.longest = std::max(spread.longest, one.time.back() - one.time.front());
    const double mean =
        (one.time.back() - one.time.front()) / static_cast<double>(one.time.size() - 1);
    spread.shortest = std::min(spread.shortest, mean);
  }
  return spread;
}

// Sums over whitened series, at unit variance.
struct Sums {
  OtherInformation by_parameters;
  double squares = 0.0;
  double log_variance = 0.0;
  double count = 0.0;
};

Sums sums_of(std::span<const TimedSeries> series, const ColouredNoise& noise) {
  Sums sums;
  const Eigen::Index width = series.empty() ? 0 : series.front().slope.cols();
  sums.by_parameters = {Eigen::MatrixXd::Zero(width, width), Eigen::VectorXd::Zero(width)};
  for (const auto& one : series) {
    const WhiteningFilter filter(noise, one.time);
    auto value = one.value;
    filter.whiten(value);
    const Eigen::Map<const Eigen::VectorXd> v(value.data(),
                                              static_cast<Eigen::Index>(value.size()));
    Eigen::MatrixXd slope = width > 0 ? one.slope : Eigen::MatrixXd(v.size(), 0);
    for (Eigen::Index k = 0; k < width; ++k) filter.whiten({slope.col(k).data(), value.size()});
    sums.by_parameters.information += slope.transpose() * slope;
    sums.by_parameters.gradient += slope.transpose() * v;
    sums.squares += v.squaredNorm();
    sums.log_variance += filter.log_variance();
    sums.count += static_cast<double>(value.size());
  }
  return sums;
}

// Minus twice the restricted log-likelihood at a variance, without constants: parameters follow.
double restricted(const Sums& sums, const OtherInformation& other, double log_sigma) {
  const double weight = std::exp(-2.0 * log_sigma);
  Eigen::MatrixXd normal = weight * sums.by_parameters.information;
  Eigen::VectorXd right = weight * sums.by_parameters.gradient;
  if (other.gradient.size() == right.size()) {
    normal += other.information;
    right += other.gradient;
  }
  const double size = normal.diagonal().maxCoeff();
  normal.diagonal().array() += kRidge * size;
  const Eigen::LDLT<Eigen::MatrixXd> solved(normal);
  return 2.0 * sums.count * log_sigma + sums.log_variance + weight * sums.squares -
         right.dot(solved.solve(right)) + solved.vectorD().array().abs().log().sum();
}

// Minus twice the log-likelihood at the best sigma, without constants.
double deviance(std::span<const TimedSeries> series, const OtherInformation& other, double share,
                double time, double& sigma) {
  const Sums sums = sums_of(series, {1.0, share, time});
  sigma = std::sqrt(sums.squares / sums.count);
  if (!(sums.squares > 0.0)) return -std::numeric_limits<double>::infinity();
  const double plain = std::log(sigma);
  if (sums.by_parameters.gradient.size() == 0) {
    return 2.0 * sums.count * plain + sums.log_variance;
  }
  const auto [log_sigma, value] = boost::math::tools::brent_find_minima(
      [&](double s) { return restricted(sums, other, s); }, plain - 2.0, plain + 2.0, kBits);
  sigma = std::exp(log_sigma);
  return value;
}

struct Point {
  double share = 0.0;
  double log_time = 0.0;
  double deviance = std::numeric_limits<double>::infinity();
};

Point coarse_search(std::span<const TimedSeries> series, const OtherInformation& other,
                    const Spread& spread) {
  Point best;
  double sigma = 0.0;
  const double from = std::log(0.3 * spread.shortest);
  const double to = std::log(0.5 * spread.longest);
  for (int t = 0; t < kTimes; ++t) {
    for (int s = 1; s <= kShares; ++s) {
      Point here{kMostShare * s / kShares, from + (to - from) * t / (kTimes - 1), 0.0};
      here.deviance = deviance(series, other, here.share, std::exp(here.log_time), sigma);
      if (here.deviance < best.deviance) best = here;
    }
  }
  return best;
}

// Compass search: derivatives are not worth having here.
Point refined(std::span<const TimedSeries> series, const OtherInformation& other, Point best) {
  double sigma = 0.0;
  const NoiseRange range = noise_range(series);
  const double from = std::log(range.shortest);
  const double to = std::log(range.longest);
  double share_step = 0.05;
  double time_step = 0.3;
  while (share_step > kFinest) {
    Point next = best;
    const double moves[4][2] = {
        {share_step, 0.0}, {-share_step, 0.0}, {0.0, time_step}, {0.0, -time_step}};
    for (const auto& move : moves) {
      Point trial{std::clamp(best.share + move[0], 0.0, kMostShare),
                  std::clamp(best.log_time + move[1], from, to), 0.0};
      trial.deviance = deviance(series, other, trial.share, std::exp(trial.log_time), sigma);
      if (trial.deviance < next.deviance) next = trial;
    }
    if (!(next.deviance < best.deviance)) {
      share_step *= 0.5;
      time_step *= 0.5;
    }
    best = next;
  }
  return best;
}

}  // namespace

WhiteningFilter::WhiteningFilter(const ColouredNoise& noise, std::span<const double> times) {
  const double stationary = noise.share * noise.sigma * noise.sigma;
  const double white = (1.0 - noise.share) * noise.sigma * noise.sigma;
  double variance = stationary;
  double settled = -1.0;  // the variance that the last step was made of
  double interval = 0.0;
  double decay = 0.0;
  steps_.reserve(times.size());
  for (std::size_t k = 0; k < times.size(); ++k) {
    double transition = 1.0;
    if (k > 0) {
      const double now = times[k] - times[k - 1];
      if (std::abs(now - interval) > kSameInterval * now) {
        interval = now;
        decay = noise.time > 0.0 ? std::exp(-interval / noise.time) : 0.0;
      }
      transition = decay;
      variance = transition * transition * variance + stationary * (1.0 - transition * transition);
    }
    if (variance == settled && transition == steps_.back().transition) {
      steps_.push_back(steps_.back());
    } else {
      settled = variance;
      const double innovation = variance + white;
      const double update = variance / innovation;
      steps_.push_back({transition, update, 1.0 / std::sqrt(innovation)});
    }
    variance *= 1.0 - steps_.back().update;
  }
}

void WhiteningFilter::whiten(std::span<double> series) const {
  double process = 0.0;
  for (std::size_t k = 0; k < steps_.size(); ++k) {
    const Step& step = steps_[k];
    process *= step.transition;
    const double innovation = series[k] - process;
    process += step.update * innovation;
    series[k] = innovation * step.weight;
  }
}

void WhiteningFilter::whiten(
    Eigen::Ref<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> rows) const {
  Eigen::RowVectorXd process = Eigen::RowVectorXd::Zero(rows.cols());
  for (std::size_t k = 0; k < steps_.size(); ++k) {
    const Step& step = steps_[k];
    auto row = rows.row(static_cast<Eigen::Index>(k));
    if (step.update > 0.0) {  // else the noise is white
      process *= step.transition;
      row -= process;
      process += step.update * row;
    }
    row *= step.weight;
  }
}

double WhiteningFilter::log_variance() const {
  double sum = 0.0;
  double weight = 1.0;
  double log_weight = 0.0;
  for (const auto& step : steps_) {
    if (step.weight != weight) {
      weight = step.weight;
      log_weight = std::log(weight);
    }
    sum -= 2.0 * log_weight;
  }
  return sum;
}

NoiseLikelihood likelihood_of(std::span<const TimedSeries> series, const OtherInformation& other,
                              double share, double time) {
  NoiseLikelihood result{{1.0, share, time}, 0.0};
  result.deviance = deviance(series, other, share, time, result.noise.sigma);
  return result;
}

NoiseRange noise_range(std::span<const TimedSeries> series) {
  const Spread spread = spread_of(series);
  return {0.1 * spread.shortest, 2.0 * spread.longest, kMostShare};
}

OtherInformation information_of(std::span<const TimedSeries> series, const ColouredNoise& noise) {
  return sums_of(series, noise).by_parameters;
}

ColouredNoise estimate_noise(std::span<const TimedSeries> series, const OtherInformation& other) {
  const Spread spread = spread_of(series);
  ColouredNoise white;
  if (spread.count == 0) return white;
  const double flat = deviance(series, other, 0.0, 0.0, white.sigma);
  if (!(spread.longest > 0.0) || !std::isfinite(flat)) return white;
  const double asked = 2.0 * std::log(static_cast<double>(spread.count));
  const Point coarse = coarse_search(series, other, spread);
  if (!(coarse.deviance + kHopeful * asked < flat)) return white;
  const Point best = refined(series, other, coarse);
  if (!(best.deviance + asked < flat)) return white;
  ColouredNoise noise{1.0, best.share, std::exp(best.log_time)};
  deviance(series, other, noise.share, noise.time, noise.sigma);
  return noise;
}

}  // namespace flexspline::estimators
