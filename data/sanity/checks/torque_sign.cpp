#include <cmath>

#include <fmt/format.h>

#include "sanity/check.hpp"
#include "sanity/evidence.hpp"

namespace flexspline::data {
namespace {

using Eigen::ArrayXd;

constexpr SanityVerdict kFalls{"check_sign", Severity::error,
                               "check the signs of torque and angle: a spring resists"};
constexpr SanityVerdict kRunsBackwards{"check_sign", Severity::error,
                                       "check the sign of the torque, which column is angle and "
                                       "which torque, and whether one is late"};

constexpr double kSpring = 0.5;      // correlation of torque and torsion that is a spring
constexpr double kDissipates = 0.1;  // of the torque's rms: with the wrong sign it is no delay

/// What the torque does along the motion: its correlation with it, and the part that changes sign
/// with the rate, over its rms.
struct Loop {
  double spring = 0.0;
  double dissipation = 0.0;
};

Loop loop_of(const Observed& o, bool travels) {
  const ArrayXd x = o.motion / std::max(o.motion.abs().maxCoeff(), 1e-300);
  const ArrayXd one = ArrayXd::Ones(x.size());
  std::vector<ArrayXd> columns = {smooth_sign(o.rate), one, x, x.square(), x.cube()};
  if (travels) columns.insert(columns.end(), {x.pow(4), x.pow(5)});
  const double rows = o.usable.sum();
  const double mean = (o.effort * o.usable).sum() / rows;
  const double mean_x = (x * o.usable).sum() / rows;
  const ArrayXd tau = (o.effort - mean) * o.usable;
  const ArrayXd phi = (x - mean_x) * o.usable;
  const double rms = std::sqrt(tau.square().sum() / rows);
  return {(tau * phi).sum() / std::sqrt(tau.square().sum() * phi.square().sum()),
          regression(columns, o.effort, o.usable).coefficient[0] / rms};
}

std::vector<SanityFinding> find(const ObservedSet& all) {
  std::vector<double> springs;
  std::vector<double> losses;
  for (const Observed& o : all.recordings) {
    if (o.motion.size() == 0 || o.effort.size() == 0 || !(o.usable.sum() > 0.0)) continue;
    const Loop loop = loop_of(o, all.travels());
    springs.push_back(loop.spring), losses.push_back(loop.dissipation);
  }
  if (springs.empty()) return {};
  const double spring = all.travels() ? 0.0 : median_of(springs);
  const double loss = median_of(losses);
  if (spring < -kSpring) {
    return {kFalls.on(
        "", fmt::format("torque falls as torsion grows: their correlation is {:.2f}", spring))};
  }
  if (loss < -kDissipates) {
    return {kRunsBackwards.on(
        "", fmt::format("the loop runs backwards: {:.2g} of the torque's rms drives the "
                        "motion instead of resisting it",
                        -loss))};
  }
  return {};
}

}  // namespace

SanityRow describe_torque_sign() {
  return {
      "torque_sign", "stiffness and dissipation that are negative", {kFalls, kRunsBackwards}, find};
}

}  // namespace flexspline::data
