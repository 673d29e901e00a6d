#include "bench/hidden_torsion.hpp"

#include <algorithm>
#include <cmath>

#include "bench/hidden_root.hpp"

namespace flexspline::data {

HiddenTorsion::HiddenTorsion(const HiddenGear& gear, std::vector<HiddenLaw>& laws, double start_s,
                             double step)
    : gear_(gear), laws_(laws), start_s_(start_s), step_(step) {
  for (const HiddenLaw& law : laws) in_series_ = in_series_ || law.windup;
}

TorsionPoint HiddenTorsion::point(double x, double rate, double load_angle) const {
  return {x, steps_ == 0 ? 0.0 : step_, gear_.gear_ratio * (x + load_angle), rate,
          start_s_ + step_ * steps_};
}

double HiddenTorsion::law(double x, double rate, double load_angle) const {
  double torque = gear_.stiffness(x) + gear_.damping(rate / gear_.modulation(x));
  const TorsionPoint here = point(x, rate, load_angle);
  for (const HiddenLaw& law : laws_) {
    if (law.transmission) torque += law.transmission(here);
  }
  return torque;
}

/// BDF2; at rest before the start, so that the first step needs nothing else.
double HiddenTorsion::implicit_rate(double x) const {
  if (steps_ == 0) return 0.0;
  return (1.5 * x - 2.0 * last_ + 0.5 * before_last_) / step_;
}

double HiddenTorsion::windup(double torque) const {
  double sum = 0.0;
  for (const HiddenLaw& law : laws_) {
    if (law.windup) sum += law.windup(torque);
  }
  return sum;
}

void HiddenTorsion::settle(double x, double load_angle) {
  const TorsionPoint here = point(x, 0.0, load_angle);
  for (HiddenLaw& law : laws_) {
    if (law.remember) law.remember(here);
  }
  before_last_ = steps_ == 0 ? x : last_;
  last_ = x;
  ++steps_;
}

template <class Residual>
double HiddenTorsion::solved(const Residual& residual) const {
  const double guess = 2.0 * last_ - before_last_;
  const double width = std::max(0.1 * std::abs(last_ - before_last_), 1e-7 * gear_.rated_torsion);
  return rising_root(residual, guess, width, 1e-14 * gear_.rated_torsion);
}

HiddenTorsion::State HiddenTorsion::follow(double torsion, double rate) {
  if (!in_series_) {
    const State state{torsion, law(torsion, rate, 0.0)};
    settle(torsion, 0.0);
    return state;
  }
  const double x = solved([&](double trial) {
    return trial + windup(law(trial, implicit_rate(trial), 0.0)) - torsion;
  });
  const State state{torsion, law(x, implicit_rate(x), 0.0)};
  settle(x, 0.0);
  return state;
}

HiddenTorsion::State HiddenTorsion::carry(double torque, double load_angle) {
  const double x =
      solved([&](double trial) { return law(trial, implicit_rate(trial), load_angle) - torque; });
  settle(x, load_angle);
  return {x + windup(torque), torque};
}

}  // namespace flexspline::data
