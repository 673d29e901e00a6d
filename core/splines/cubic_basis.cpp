#include "flexspline/core/cubic_basis.hpp"

#include <algorithm>
#include <cmath>

namespace flexspline {

CubicBasis::CubicBasis(double from, double to, std::size_t intervals)
    : from_(from), width_((to - from) / static_cast<double>(intervals)), intervals_(intervals) {}

CubicBasis::Local CubicBasis::at(double x) const {
  const double z = (x - from_) / width_;
  const double cell = std::clamp(std::floor(z), 0.0, static_cast<double>(intervals_ - 1));
  const double u = z - cell;
  const double v = 1.0 - u;
  const double w = width_;
  Local local;
  local.first = static_cast<std::size_t>(cell);
  local.value = {v * v * v / 6.0, (3.0 * u * u * u - 6.0 * u * u + 4.0) / 6.0,
                 (-3.0 * u * u * u + 3.0 * u * u + 3.0 * u + 1.0) / 6.0, u * u * u / 6.0};
  local.slope = {-v * v / (2.0 * w), (3.0 * u * u - 4.0 * u) / (2.0 * w),
                 (-3.0 * u * u + 2.0 * u + 1.0) / (2.0 * w), u * u / (2.0 * w)};
  local.curvature = {v / (w * w), (3.0 * u - 2.0) / (w * w), (1.0 - 3.0 * u) / (w * w),
                     u / (w * w)};
  return local;
}

}  // namespace flexspline
