#pragma once

#include <memory>

#include "diagnosis/frame/frame.hpp"

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

  /// What the filter makes the given of, row by row: apply() gives it back. Stable:
  /// |b| < a.
  Eigen::ArrayXd undone(const Eigen::ArrayXd& y) const;

 private:
  template <std::size_t count>
  void apply_to(double* first_column, Eigen::Index stride) const;

  std::vector<Segment> segments_;
  Eigen::ArrayXd now_, before_, kept_;  ///< a, b, k by row
};

/// The filter of a frame, kept with its columns: one for each time constant, s, and all frames of
/// the same times and segments. Thread-safe.
std::shared_ptr<const LowPass> shared_low_pass(const Frame& frame, double time_constant);

}  // namespace flexspline::studies
