#pragma once

#include <algorithm>

namespace flexspline {

/// Elastic-plastic stop of unit stiffness (Jenkins, Prandtl; one Maxwell slip element):
/// s' = x' unless |s| would exceed the yield r. Exact along any monotone piece of x; rate
/// independent. Starts unloaded.
class StopOperator {
 public:
  explicit StopOperator(double yield) : yield_(yield) {}
  double advance(double dx) {
    state_ = std::clamp(state_ + dx, -yield_, yield_);
    return state_;
  }

 private:
  double yield_;
  double state_ = 0.0;
};

}  // namespace flexspline
