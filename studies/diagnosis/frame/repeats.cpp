#include "diagnosis/frame/repeats.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

constexpr double kGone = 0.5;      // of the mean square between two rows anywhere: it has gone away
constexpr double kExactly = 1e-4;  // of the same: it is back
constexpr double kOnce = 4.0;      // of a mean square, what a single row may miss by

// What half a row's way is of a sine of that many rows, in a mean square over that between two rows
// anywhere.
double half_a_row(Index period) {
  return kExactly + std::pow(std::numbers::pi / static_cast<double>(period), 2);
}

// Mean square of the last rows' motion less that so many rows earlier.
double missed(const ArrayXd& motion, Index lag, Index rows) {
  const Index n = motion.size();
  return (motion.tail(rows) - motion.segment(n - lag - rows, rows)).square().mean();
}

Index rows_of_last(Index lag) { return std::max(kFewestCompared, lag / 2); }

// The first return: the best between going away and going away again.
Index period_of(const ArrayXd& motion, double anywhere) {
  bool gone = false;
  double least = std::numeric_limits<double>::infinity();
  Index period = 0;
  for (Index lag = 1; lag + rows_of_last(lag) <= motion.size(); ++lag) {
    const double now = missed(motion, lag, rows_of_last(lag)) / anywhere;
    if (now > kGone && period > 0) break;
    gone = gone || now > kGone;
    if (gone && now < least && now < half_a_row(lag)) least = now, period = lag;
  }
  return period;
}

}  // namespace

Repeat repeat_of(const ArrayXd& motion) {
  if (motion.size() <= kFewestCompared) return {};
  const double anywhere = 2.0 * (motion - motion.mean()).square().mean();
  if (!(anywhere > 0.0)) return {};
  Repeat repeat{period_of(motion, anywhere), 0};
  if (repeat.period == 0) return {};
  const double most = kOnce * half_a_row(repeat.period) * anywhere;
  const Index n = motion.size() - repeat.period;
  while (repeat.rows < n) {
    const Index r = n - 1 - repeat.rows;
    if (std::pow(motion[r + repeat.period] - motion[r], 2) > most) break;
    ++repeat.rows;
  }
  return repeat.rows < kFewestCompared ? Repeat{} : repeat;
}

std::vector<ArrayXd> unrepeated(const Frame& frame, const ArrayXd& residual) {
  std::vector<ArrayXd> list;
  for (const Segment& s : frame.segments) {
    const Index later = s.first + s.count - s.repeat.rows;
    const auto of = [&](const ArrayXd& x, Index at) { return x.segment(at, s.repeat.rows); };
    const ArrayXd both = of(frame.usable, later) * of(frame.usable, later - s.repeat.period);
    const ArrayXd differ = of(residual, later) - of(residual, later - s.repeat.period);
    list.push_back(
        (both > 0.0)
            .select(differ / std::numbers::sqrt2, std::numeric_limits<double>::quiet_NaN()));
  }
  return list;
}

}  // namespace flexspline::studies
