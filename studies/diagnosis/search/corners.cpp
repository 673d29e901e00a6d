#include "diagnosis/search/corners.hpp"

#include <algorithm>

#include "diagnosis/frame/middle.hpp"
#include "diagnosis/frame/running.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

constexpr double kCorner = 6.0;  // change of the acceleration in a row over the usual one
constexpr Index kCornerRows = 10;

}  // namespace

Corners::Corners(const Frame& frame, const Segment& s) : sharpness_(ArrayXd::Zero(s.count)) {
  const ArrayXd a = frame.motor_acceleration.segment(s.first, s.count);
  const ArrayXd jump = (a.tail(a.size() - 1) - a.head(a.size() - 1)).abs();
  for (Index r = 0; r < s.count; ++r) {
    const Index from = std::max<Index>(0, r - kCornerRows);
    const Index to = std::min(jump.size(), r + kCornerRows);
    sharpness_[r] = jump.segment(from, to - from).maxCoeff();
  }
  const double usual = middle({jump.begin(), jump.end()});
  count_ = running_sum((sharpness_ > kCorner * usual).cast<double>());
}

bool Corners::touched(Index first, Index count, Index further) const {
  const Index from = std::max<Index>(0, first - further);
  const Index to = std::min(sharpness_.size(), first + count + further);
  return count_[to] > count_[from];
}

double Corners::sharpest(Index first, Index count) const {
  return count > 0 ? sharpness_.segment(first, count).maxCoeff() : 0.0;
}

}  // namespace flexspline::studies
