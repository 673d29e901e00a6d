#include "diagnosis/calibrated.hpp"

#include <cmath>
#include <numbers>

namespace flexspline::studies {
namespace {

constexpr double kLeastShare = 0.002;
constexpr double kMostMisfit = std::numbers::sqrt2;   // beyond it cases are too few to tell more
constexpr double kLeastLeft = 1e-3, kMostLeft = 0.3;  // neither are they beyond these
constexpr double kNone = 6.1, kOfShare = 0.9, kOfMisfit = -10.5, kOfLeft = -0.5,
                 kOfAlternatives = -1.6;

// NaN stays.
double within(double x, double lower, double upper) {
  return x < lower ? lower : x > upper ? upper : x;
}

}  // namespace

double probability_right(const NameEvidence& e) {
  const double share = within(1.0 - e.ratio * e.ratio, kLeastShare, 1.0);
  const double misfit = within(e.over_noise, 1.0, kMostMisfit);
  const double left = within(e.left_over, kLeastLeft, kMostLeft) / kLeastLeft;
  const double log_odds = kNone + kOfShare * std::log(share) + kOfMisfit * std::log(misfit) +
                          kOfLeft * std::log(left) +
                          kOfAlternatives * static_cast<double>(e.alternatives);
  return 1.0 / (1.0 + std::exp(-log_odds));
}

}  // namespace flexspline::studies
