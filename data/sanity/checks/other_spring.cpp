#include <cmath>

#include <fmt/format.h>

#include "sanity/check.hpp"
#include "sanity/evidence.hpp"

namespace flexspline::data {
namespace {

using Eigen::ArrayXd;

constexpr std::string_view kGear =
    "see whether it is of another gear, or of another gain of a sensor";
constexpr SanityVerdict kBackwards{"check_sign", Severity::error, kGear};
constexpr SanityVerdict kOtherGear{"check_channel", Severity::error, kGear};
constexpr SanityVerdict kOtherSlope{"check_channel", Severity::warning, kGear};

constexpr double kAsWide = 1.5;    // motions whose widths differ by less are compared
constexpr double kMistaken = 2.5;  // of the slope
constexpr double kOff = 1.6;
constexpr double kSpring = 0.8;  // of the torque's variance that follows the torsion

/// Slope of the torque over the motion of a recording, and how wide that is.
struct Spring {
  std::string recording;
  double slope = 0.0;
  double width = 0.0;
};

std::vector<Spring> springs_of(const ObservedSet& all) {
  std::vector<Spring> list;
  for (const Observed& o : all.recordings) {
    if (o.motion.size() == 0 || o.effort.size() == 0) continue;
    const auto fit = regression({o.motion, smooth_sign(o.rate), ArrayXd::Ones(o.time.size())},
                                o.effort, o.usable);
    if (fit.explained < kSpring || fit.coefficient[0] == 0.0) continue;
    list.push_back({o.recording->id, fit.coefficient[0], range_of(o.motion)});
  }
  return list;
}

/// Slope of one over the median of those that are as wide; 1 where fewer than two are.
double against_others(const Spring& one, const std::vector<Spring>& all) {
  std::vector<double> slopes;
  for (const Spring& other : all) {
    const bool alike = !is_off(other.width / one.width, kAsWide);
    if (&other != &one && alike) slopes.push_back(other.slope);
  }
  return slopes.size() < 2 ? 1.0 : one.slope / median_of(slopes);
}

std::vector<SanityFinding> find(const ObservedSet& all) {
  if (all.travels()) return {};
  std::vector<SanityFinding> list;
  const auto springs = springs_of(all);
  for (const Spring& spring : springs) {
    const double factor = against_others(spring, springs);
    if (!is_off(factor, kOff)) continue;
    const SanityVerdict& verdict = factor < 0.0                ? kBackwards
                                   : is_off(factor, kMistaken) ? kOtherGear
                                                               : kOtherSlope;
    list.push_back(
        verdict.on(spring.recording,
                   fmt::format("torque over torsion is {:.3g} times that of the recordings of "
                               "like width",
                               factor)));
  }
  return list;
}

}  // namespace

SanityRow describe_other_spring() {
  return {"other_spring",
          "a recording whose spring differs from the others'",
          {kBackwards, kOtherGear, kOtherSlope},
          find};
}

}  // namespace flexspline::data
