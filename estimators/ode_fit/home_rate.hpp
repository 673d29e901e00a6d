#pragma once

namespace flexspline::estimators {

/// The share of starts that come home, with Clopper and Pearson's 95 % interval.
struct HomeRate {
  double rate;
  double lower;
  double upper;
};
HomeRate home_rate(int home, int starts);

}  // namespace flexspline::estimators
