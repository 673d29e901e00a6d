#pragma once

#include <vector>

#include "bench/hidden_law.hpp"

namespace flexspline::data {

/// The gear's torsion law with what effects add, stepped along one recording:
/// tau = f(x) + g^-1(x'/h(x)) + additions, torsion = x + windup(tau).
class HiddenTorsion {
 public:
  HiddenTorsion(const HiddenGear& gear, std::vector<HiddenLaw>& laws, double start_s, double step);

  struct State {
    double torsion = 0.0;  ///< with what is in series
    double torque = 0.0;
  };

  /// The next instant where the whole torsion and its rate are held; load_angle turns the motor.
  State follow(double torsion, double rate);
  /// The next instant where the torque is given.
  State carry(double torque, double load_angle);

 private:
  double law(double x, double rate, double load_angle) const;
  TorsionPoint point(double x, double rate, double load_angle) const;
  double implicit_rate(double x) const;
  double windup(double torque) const;
  void settle(double x, double load_angle);
  template <class Residual>
  double solved(const Residual& residual) const;

  const HiddenGear& gear_;
  std::vector<HiddenLaw>& laws_;
  double start_s_;
  double step_;
  bool in_series_ = false;
  int steps_ = 0;
  double last_ = 0.0;  ///< x of the last two instants
  double before_last_ = 0.0;
};

}  // namespace flexspline::data
