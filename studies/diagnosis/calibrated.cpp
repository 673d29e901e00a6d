#include "diagnosis/calibrated.hpp"

#include <cmath>
#include <numbers>

namespace flexspline::studies {
namespace {

constexpr double kLeastShare = 0.002;
constexpr double kMostMisfit = std::numbers::sqrt2;  // beyond it cases are too few to tell more
constexpr double kNone = 5.4, kOfShare = 1.3, kOfMisfit = -10.4, kOfNames = -0.95,
                 kOfAlternatives = -1.1;

// NaN stays.
double within(double x, double lower, double upper) {
  return x < lower ? lower : x > upper ? upper : x;
}

}  // namespace

double probability_right(const NameEvidence& e) {
  const double share = within(1.0 - e.ratio * e.ratio, kLeastShare, 1.0);
  const double misfit = within(e.over_noise, 1.0, kMostMisfit);
  const double log_odds = kNone + kOfShare * std::log(share) + kOfMisfit * std::log(misfit) +
                          kOfNames * (static_cast<double>(e.names) - 1.0) +
                          kOfAlternatives * static_cast<double>(e.alternatives);
  return 1.0 / (1.0 + std::exp(-log_odds));
}

}  // namespace flexspline::studies
