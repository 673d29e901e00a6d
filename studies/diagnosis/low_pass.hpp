#pragma once

#include "diagnosis/frame.hpp"

namespace flexspline::studies {

/// A filter of first order along every recording, T y' + y = x, exact for x linear between rows,
/// settled at the start: y_r = a_r x_r + b_r x_(r-1) + k_r y_(r-1), k = exp(-dt/T),
/// a = 1 - m, b = m - k, m = (1 - k) T/dt.
class LowPass {
 public:
  /// time_constant > 0, s.
  LowPass(const Frame& frame, double time_constant);

  /// Filters every column in its place.
  void apply(Eigen::Ref<Eigen::MatrixXd> columns) const;

 private:
  std::vector<Segment> segments_;
  Eigen::ArrayXd now_, before_, kept_;  ///< a, b, k by row
};

}  // namespace flexspline::studies
