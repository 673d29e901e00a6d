// The classical Runge-Kutta formula of order 4.
#pragma once

#include "kernels/lane_rate.hpp"

template <int kLanes>
class RungeKuttaStep {
 public:
  using Number = typename Lane<kLanes>::Number;

  RungeKuttaStep(const double* torque, Number) : torque_(torque + kLanes) {
    start_ = Lane<kLanes>::load(torque);
  }

  void take(const Terms& terms, Number width, Number& x) {
    const Number middle = Lane<kLanes>::load(torque_);
    const Number end = Lane<kLanes>::load(torque_ + kLanes);
    const Number half = 0.5 * width;
    stage_[0] = rate_of<kLanes>(terms, start_, x);
    stage_[1] = rate_of<kLanes>(terms, middle, x + half * stage_[0].value);
    stage_[2] = rate_of<kLanes>(terms, middle, x + half * stage_[1].value);
    stage_[3] = rate_of<kLanes>(terms, end, x + width * stage_[2].value);
    x += width * (1.0 / 6.0) *
         (stage_[0].value + 2.0 * (stage_[1].value + stage_[2].value) + stage_[3].value);
    torque_ += 2 * kLanes;
    start_ = end;
  }

  Number slope() const { return stage_[0].slope; }

  /// What each stage's dF/dp adds to a tangent, and by what the step multiplies it.
  Number weigh(Number width) {
    share_[3] = width * (1.0 / 6.0);
    share_[2] = width * (1.0 / 3.0) + share_[3] * stage_[3].slope * width;
    share_[1] = width * (1.0 / 3.0) + share_[2] * stage_[2].slope * (0.5 * width);
    share_[0] = width * (1.0 / 6.0) + share_[1] * stage_[1].slope * (0.5 * width);
    return 1.0 + share_[0] * stage_[0].slope + share_[1] * stage_[1].slope +
           share_[2] * stage_[2].slope + share_[3] * stage_[3].slope;
  }

  void advance(const Terms& terms, Number keep, Number* tangent) const {
    advance_tangents<kLanes, 4>(terms, stage_, share_, keep, tangent);
  }

 private:
  const double* torque_;
  Number start_;
  Rate<kLanes> stage_[4];
  Number share_[4];
};
