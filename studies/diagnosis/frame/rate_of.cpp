#include "diagnosis/frame/rate_of.hpp"

namespace flexspline::studies {

Eigen::ArrayXd rate_of(const Frame& frame, const Eigen::ArrayXd& signal) {
  Eigen::ArrayXd rate = Eigen::ArrayXd::Zero(signal.size());
  for (const Segment& s : frame.segments) {
    for (Eigen::Index r = s.first + 1; r + 1 < s.first + s.count; ++r) {
      rate[r] = (signal[r + 1] - signal[r - 1]) / (frame.time[r + 1] - frame.time[r - 1]);
    }
  }
  return rate;
}

}  // namespace flexspline::studies
