#include "diagnosis/frame/low_pass.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace flexspline::studies {

using Eigen::Index;

namespace {
// Two steps differ by the rounding of the times that they are differences of.
bool same_step(double a, double b, double time) {
  return std::abs(a - b) <= 2.0 * std::numeric_limits<double>::epsilon() * std::abs(time);
}

}  // namespace

LowPass::LowPass(const Frame& frame, double time_constant)
    : segments_(frame.segments), now_(frame.rows()), before_(frame.rows()), kept_(frame.rows()) {
  for (const Segment& s : segments_) {
    now_[s.first] = 1.0, before_[s.first] = 0.0, kept_[s.first] = 0.0;
    double known = 0.0;
    for (Index r = s.first + 1; r < s.first + s.count; ++r) {
      const double interval = frame.time[r] - frame.time[r - 1];
      if (same_step(interval, known, frame.time[r])) {
        now_[r] = now_[r - 1], before_[r] = before_[r - 1], kept_[r] = kept_[r - 1];
        continue;
      }
      known = interval;
      const double step = interval / time_constant;
      const double settled = -std::expm1(-step);
      const double mean = settled / step;
      now_[r] = 1.0 - mean;
      before_[r] = mean - (1.0 - settled);
      kept_[r] = 1.0 - settled;
    }
  }
}

template <std::size_t count>
void LowPass::apply_to(double* first_column, Index stride) const {
  std::array<double*, count> column{};
  for (std::size_t k = 0; k < count; ++k) column[k] = first_column + static_cast<Index>(k) * stride;
  for (const Segment& s : segments_) {
    std::array<double, count> x{}, y{};
    for (Index r = s.first; r < s.first + s.count; ++r) {
      for (std::size_t k = 0; k < count; ++k) {
        const double now = column[k][r];
        y[k] = now_[r] * now + before_[r] * x[k] + kept_[r] * y[k];
        x[k] = now;
        column[k][r] = y[k];
      }
    }
  }
}

// Several columns at a time: each waits for its own last row, not for another's.
void LowPass::apply(Eigen::Ref<Eigen::MatrixXd> columns) const {
  const Index stride = columns.outerStride();
  for (Index k = 0; k < columns.cols();) {
    double* const column = columns.data() + k * stride;
    const Index left = columns.cols() - k;
    if (left >= 8) {
      apply_to<8>(column, stride), k += 8;
    } else if (left >= 4) {
      apply_to<4>(column, stride), k += 4;
    } else {
      apply_to<1>(column, stride), k += 1;
    }
  }
}

Eigen::ArrayXd LowPass::undone(const Eigen::ArrayXd& y) const {
  Eigen::ArrayXd x(y.size());
  for (const Segment& s : segments_) {
    x[s.first] = y[s.first];
    for (Index r = s.first + 1; r < s.first + s.count; ++r) {
      x[r] = (y[r] - before_[r] * x[r - 1] - kept_[r] * y[r - 1]) / now_[r];
    }
  }
  return x;
}

}  // namespace flexspline::studies
