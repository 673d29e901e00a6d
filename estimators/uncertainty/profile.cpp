#include "uncertainty/profile.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace flexspline::estimators {
namespace {

constexpr int kTrials = 40;
constexpr double kFar = 1e4;         // first steps without a rise that count as infinity
constexpr double kLongest = 4.0;     // times the last step
constexpr int kPatient = 3;          // steps along the line before larger ones are taken
constexpr double kFirstShare = 0.1;  // of the typical size, where the covariance says nothing
constexpr double kBetter = 1e-5;     // of the variance, that rounding may take off the cost

// The problem with one parameter held.
class Held final : public LeastSquaresProblem {
 public:
  Held(const LeastSquaresProblem& problem, std::size_t index, double value)
      : problem_(problem), index_(index), value_(value) {}

  std::size_t blocks() const override { return problem_.blocks(); }
  std::size_t residuals(std::size_t block) const override { return problem_.residuals(block); }
  Result<void> evaluate(std::size_t block, std::span<const double> rest, std::span<double> residual,
                        std::span<double> jacobian) const override {
    const auto p = whole(rest);
    std::vector<double> wide(jacobian.empty() ? 0 : residual.size() * p.size());
    auto done = problem_.evaluate(block, p, residual, wide);
    if (!done) return done;
    for (std::size_t k = 0, to = 0; k < wide.size(); ++k) {
      if (k % p.size() != index_) jacobian[to++] = wide[k];
    }
    return {};
  }

  std::vector<double> whole(std::span<const double> rest) const {
    std::vector<double> p(rest.begin(), rest.end());
    p.insert(p.begin() + static_cast<std::ptrdiff_t>(index_), value_);
    return p;
  }

 private:
  const LeastSquaresProblem& problem_;
  std::size_t index_;
  double value_;
};

class Profile {
 public:
  Profile(const LeastSquaresProblem& problem, std::span<const BoundedParameter> parameters,
          std::span<const double> p, const Eigen::MatrixXd& covariance, std::size_t k,
          const ProfileSettings& settings, double least)
      : problem_(problem),
        parameters_(parameters.begin(), parameters.end()),
        p_(p.begin(), p.end()),
        covariance_(covariance),
        index_(k),
        settings_(settings),
        least_(least) {}

  long evaluations = 0;

  /// Root of twice the rise of the cost over the variance, at a distance from the minimum.
  Result<double> rise(double distance) {
    const Held held(problem_, index_, p_[index_] + distance);
    auto rest = others(distance);
    double cost = 0.0;
    if (rest.empty()) {
      const auto alone = half_sum_of_squares(held, {});
      if (!alone) return tl::unexpected(alone.error());
      cost = *alone;
      evaluations += static_cast<long>(problem_.blocks());
    } else {
      const auto found = minimise(held, rest, settings_.solver);
      if (!found) return tl::unexpected(found.error());
      cost = found->cost;
      evaluations += found->evaluations;
      nearest_ = {distance, found->p};
    }
    const double rise = 2.0 * (cost - least_) / settings_.variance;
    if (rise < -std::max(kBetter, settings_.tolerance)) return better(distance, cost);
    return std::sqrt(std::max(0.0, rise));
  }

  double room(double sign) const {
    const auto& own = parameters_[index_];
    return sign > 0.0 ? own.upper - p_[index_] : p_[index_] - own.lower;
  }

  double first_step() const {
    const double variance = at(index_, index_);
    if (variance > 0.0 && std::isfinite(variance)) return settings_.quantile * std::sqrt(variance);
    return kFirstShare * parameters_[index_].scale;
  }

 private:
  double at(std::size_t a, std::size_t b) const {
    return covariance_(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b));
  }

  // How fast another parameter follows: as it did up to the last fit on this side, or as in a
  // linear model.
  double slope(std::size_t k, std::size_t position, double distance) const {
    if (nearest_.distance * distance > 0.0) {
      return (nearest_.rest[position] - p_[k]) / nearest_.distance;
    }
    const double variance = at(index_, index_);
    return variance > 0.0 ? at(k, index_) / variance : 0.0;
  }

  std::vector<BoundedParameter> others(double distance) const {
    std::vector<BoundedParameter> rest;
    for (std::size_t k = 0; k < p_.size(); ++k) {
      if (k == index_) continue;
      const double slope = this->slope(k, rest.size(), distance);
      BoundedParameter one = parameters_[k];
      const double moved = p_[k] + (std::isfinite(slope) ? slope * distance : 0.0);
      one.start = std::clamp(moved, one.lower, one.upper);
      rest.push_back(one);
    }
    return rest;
  }

  Result<double> better(double distance, double cost) const {
    return failure(
        ErrorCode::numerics,
        fmt::format("with parameter {} held at {:.6g} the cost is {:.9g}, below the {:.9g} of the "
                    "fit",
                    index_ + 1, p_[index_] + distance, cost, least_),
        "the fit is not the minimum: start it from there");
  }

  // A held fit: how far the parameter was held from the minimum, and the others.
  struct HeldFit {
    double distance = 0.0;
    std::vector<double> rest;
  };

  const LeastSquaresProblem& problem_;
  std::vector<BoundedParameter> parameters_;
  std::vector<double> p_;
  HeldFit nearest_;
  const Eigen::MatrixXd& covariance_;
  std::size_t index_;
  const ProfileSettings& settings_;
  double least_;
};

struct Point {
  double distance = 0.0;
  double rise = 0.0;
};

// Between two points the root of the rise is nearly straight; halves where it is not.
double between(const Point& inside, const Point& outside, double quantile, bool halve) {
  if (!std::isfinite(outside.rise) || halve) return 0.5 * (inside.distance + outside.distance);
  const double share = (quantile - inside.rise) / (outside.rise - inside.rise);
  return inside.distance + share * (outside.distance - inside.distance);
}

// Where the line through the last two points reaches the quantile; not a number where it does not.
double on_line(const Point& before, const Point& last, double quantile) {
  const double steepness = (last.rise - before.rise) / (last.distance - before.distance);
  return steepness > 0.0 ? last.distance + (quantile - last.rise) / steepness : kNotComputed;
}

// How far out to look next, where the profile has not yet been seen above the quantile.
double further(const Point& before, const Point& last, double quantile, int trials) {
  const double line = on_line(before, last, quantile);
  if (trials < kPatient && line > last.distance) return std::min(line, kLongest * last.distance);
  const double factor = last.rise > 0.0 ? 1.05 * quantile / last.rise : kLongest;
  return last.distance * std::clamp(factor, 1.1, kLongest);
}

// Distance at which the profile reaches the quantile on one side; infinity where it does not.
Result<double> reach(Profile& profile, double sign, double quantile, double tolerance) {
  const double room = profile.room(sign);
  const double first = std::min(profile.first_step(), room);
  if (!(room > 0.0)) return std::numeric_limits<double>::infinity();
  Point inside;
  Point outside{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Point before;
  double trial = first;
  std::optional<Error> failed;
  for (int k = 0; k < kTrials; ++k) {
    const auto rise = profile.rise(sign * trial);
    if (!rise) failed = rise.error();
    if (rise && std::abs(*rise - quantile) < tolerance * quantile) return trial;
    const Point last{trial, rise ? *rise : std::numeric_limits<double>::infinity()};
    if (last.rise < quantile) {
      inside = last;
      if (trial >= room || trial > kFar * first) return std::numeric_limits<double>::infinity();
    } else {
      outside = last;
    }
    if (std::isfinite(outside.distance)) {
      trial = on_line(before, last, quantile);
      const bool within = trial > inside.distance && trial < outside.distance;
      if (!within || k % 5 == 4) trial = between(inside, outside, quantile, k % 5 == 4);
    } else {
      trial = std::min(further(before, last, quantile, k), room);
    }
    before = last;
  }
  if (!std::isfinite(outside.rise) && failed) return tl::unexpected(*failed);
  return 0.5 * (inside.distance + std::min(outside.distance, kFar * first));
}

}  // namespace

Result<ProfileInterval> profile_interval(const LeastSquaresProblem& problem,
                                         std::span<const BoundedParameter> parameters,
                                         std::span<const double> p,
                                         const Eigen::MatrixXd& covariance, std::size_t k,
                                         const ProfileSettings& settings) {
  const auto least = half_sum_of_squares(problem, p);
  if (!least) return tl::unexpected(least.error());
  Profile profile(problem, parameters, p, covariance, k, settings, *least);
  const auto down = reach(profile, -1.0, settings.quantile, settings.tolerance);
  const auto up = reach(profile, 1.0, settings.quantile, settings.tolerance);
  if (!down || !up) return tl::unexpected(down ? up.error() : down.error());
  ProfileInterval interval;
  interval.lower_open = std::isinf(*down);
  interval.upper_open = std::isinf(*up);
  interval.lower = interval.lower_open ? parameters[k].lower : p[k] - *down;
  interval.upper = interval.upper_open ? parameters[k].upper : p[k] + *up;
  interval.evaluations = profile.evaluations;
  return interval;
}

}  // namespace flexspline::estimators
