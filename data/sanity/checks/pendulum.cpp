#include <cmath>

#include <fmt/format.h>

#include "sanity/check.hpp"
#include "sanity/evidence.hpp"

namespace flexspline::data {
namespace {

using Eigen::ArrayXd;

constexpr SanityVerdict kTurns{
    "check_units", Severity::error,
    "check the unit of load_angle: degrees may have been taken for radians"};
constexpr SanityVerdict kDrives{"check_sign", Severity::error,
                                "check the sign of the drive's channel against load_angle"};

constexpr double kClear = 10.0;     // standard errors, of white noise
constexpr double kMostTurns = 6.0;  // of a pendulum

/// What a servo's drive does along the motion, by u = a sin(theta) + b theta'' + c |theta'| + d.
struct Drive {
  double gravity = 0.0;   ///< a over its standard error
  double friction = 0.0;  ///< c over its standard error
};

std::vector<SanityFinding> find(const ObservedSet& all) {
  if (all.set.rig != Rig::servo) return {};
  std::vector<double> gravity;
  std::vector<double> friction;
  double widest = 0.0;
  for (const Observed& o : all.recordings) {
    if (o.load_angle.size() == 0 || o.drive.size() == 0) continue;
    widest = std::max(widest, o.load_angle.abs().maxCoeff());
    const auto fit = regression({o.load_angle.sin(), smooth_sign(o.load_speed), o.load_acceleration,
                                 ArrayXd::Ones(o.time.size())},
                                o.drive, o.usable);
    gravity.push_back(fit.coefficient[0] / fit.error[0]);
    friction.push_back(fit.coefficient[1] / fit.error[1]);
  }
  std::vector<SanityFinding> list;
  const double turns = widest / 6.283185307179586;
  if (turns > kMostTurns) {
    list.push_back(kTurns.on("", fmt::format("the pendulum turns {:.3g} times", turns)));
  }
  if (median_of(friction) < -kClear && median_of(gravity) < kClear) {
    list.push_back(kDrives.on(
        "", fmt::format("the drive acts along with the friction: {:.3g} standard errors in "
                        "the direction of motion, {:.3g} along gravity",
                        median_of(friction), median_of(gravity))));
  }
  return list;
}

}  // namespace

SanityRow describe_pendulum() {
  return {"pendulum", "sign and scale of a servo's angle and drive", {kTurns, kDrives}, find};
}

}  // namespace flexspline::data
