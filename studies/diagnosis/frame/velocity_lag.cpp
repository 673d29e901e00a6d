#include "diagnosis/frame/velocity_lag.hpp"

#include <cmath>

#include <fmt/format.h>
#include <boost/math/tools/minima.hpp>

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;

constexpr double kNothing = 0.01;  // of the speed: less is the smoothing's own error
constexpr double kMostly = 0.5;    // of what a mere scale leaves, that filters may leave
constexpr int kBits = 20;

class Comparison {
 public:
  explicit Comparison(const Frame& frame)
      : frame_(frame), counts_(frame.usable * frame.velocity.isFinite().cast<double>()) {
    velocity_ = counts_.select(frame.velocity, 0.0);
  }

  bool possible() const { return counts_.sum() > 0.0 && speed() > 0.0; }

  double left(int filters, double time_constant) const {
    ArrayXd expected = frame_.load_speed;
    for (int k = 0; k < filters; ++k) expected = frame_.filtered(expected, time_constant);
    return rms(velocity_ - expected) / speed();
  }

  /// With w = c dq/dt at the best c.
  double left_by_a_scale() const {
    const ArrayXd& slope = frame_.load_speed;
    const double scale = (counts_ * slope * velocity_).sum() / (counts_ * slope.square()).sum();
    return rms(velocity_ - scale * slope) / speed();
  }

 private:
  double rms(const ArrayXd& values) const {
    return std::sqrt((counts_ * values.square()).sum() / counts_.sum());
  }
  double speed() const { return rms(frame_.load_speed); }

  const Frame& frame_;
  ArrayXd counts_;
  ArrayXd velocity_;
};

}  // namespace

std::optional<VelocityLag> velocity_lag(const Frame& frame) {
  if (frame.velocity.size() != frame.rows()) return std::nullopt;
  const Comparison comparison(frame);
  if (!comparison.possible()) return std::nullopt;
  const double before = comparison.left(0, 0.0);
  const double longest = frame.longest_lag();
  if (before < kNothing || !std::isfinite(longest)) return std::nullopt;
  VelocityLag best{.before = before, .after = before};
  for (int filters : {1, 2}) {
    const auto [time_constant, after] =
        boost::math::tools::brent_find_minima([&](double t) { return comparison.left(filters, t); },
                                              0.1 * frame.interval, longest, kBits);
    if (after < best.after) best = {filters, time_constant, before, after};
  }
  if (best.after > kMostly * comparison.left_by_a_scale()) return std::nullopt;
  return best;
}

std::string in_words(const VelocityLag& lag) {
  return fmt::format(
      "the recorded velocity differs from the slope of the angle by {:.2g} % of the speed, from "
      "that "
      "slope behind {} of {:.2g} s{} by {:.2g} %: read off the motion alone; a torque recorded "
      "with "
      "it may come through the like",
      100.0 * lag.before, lag.filters == 1 ? "a filter" : "two filters", lag.time_constant,
      lag.filters == 1 ? "" : " each", 100.0 * lag.after);
}

}  // namespace flexspline::studies
