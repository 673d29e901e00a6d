#include "diagnosis/proof/calibrated.hpp"

#include <cmath>
#include <numeric>

namespace flexspline::studies {
namespace {

constexpr double kLeastShare = 0.002;
constexpr double kLeast = 1e-3;        // of what is left over; cases are too few to tell less
constexpr double kMostLeftOver = 0.3;  // beyond it cases are too few to tell more
constexpr double kNone = 5.5, kOfShare = 0.7, kOfRest = -10.0, kOfLeftOver = -0.6,
                 kOfAlternatives = -1.4;

// NaN stays.
double within(double x, double lower, double upper) {
  return x < lower ? lower : x > upper ? upper : x;
}

// Of the baseline's mean square what the whole model leaves beyond noise.
double rest(double over_noise, double before_over_noise) {
  return (over_noise * over_noise - 1.0) / (before_over_noise * before_over_noise);
}

}  // namespace

double probability_right(const NameEvidence& e) {
  const double share = within(1.0 - e.ratio * e.ratio, kLeastShare, 1.0);
  const double misfit = within(rest(e.over_noise, e.before_over_noise), 0.0, 1.0);
  const double left = within(e.left_over, kLeast, kMostLeftOver) / kLeast;
  const double log_odds = kNone + kOfShare * std::log(share) + kOfRest * misfit +
                          kOfLeftOver * std::log(left) +
                          kOfAlternatives * static_cast<double>(e.alternatives);
  const double of_all = 1.0 / (1.0 + std::exp(-log_odds));
  return std::accumulate(e.in_folds.begin(), e.in_folds.end(), of_all) /
         static_cast<double>(1 + e.in_folds.size());
}

}  // namespace flexspline::studies
