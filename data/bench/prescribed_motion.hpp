#pragma once

#include <utility>
#include <vector>

#include "flexspline/data/bench.hpp"

namespace flexspline::data {

/// A time counted in cycles, in two parts so that every steady cycle has the same bits.
struct CycleInstant {
  int cycle = 0;
  double fraction = 0.0;  ///< [0, 1)
};

struct MotionPoint {
  double position = 0.0;
  double velocity = 0.0;
  double acceleration = 0.0;
};

/// phi = A r (sin a + sum share_k cos(k (a - pi/2) + phase_k)), a = 2 pi f t. The ramp r rises from
/// 0 to 1 over the first half cycle with three continuous derivatives; before t = 0 there is rest.
/// Half a cycle, so that the first valley already has the full depth and slip elements that
/// started unloaded are on their steady loop when the second cycle begins.
class PrescribedMotion {
 public:
  PrescribedMotion(const BenchExcitation& excitation,
                   std::vector<std::pair<int, std::pair<double, double>>> harmonics);

  MotionPoint at(CycleInstant instant) const;

  /// The instant of a sample, and offset samples and late_s seconds away from it.
  CycleInstant instant(int sample, double offset, double late_s) const;

 private:
  MotionPoint waveform(double fraction) const;

  BenchExcitation excitation_;
  std::vector<std::pair<int, std::pair<double, double>>> harmonics_;
};

}  // namespace flexspline::data
