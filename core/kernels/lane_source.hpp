// Everything that a kernel is made of, for the translation unit that defines FLEXSPLINE_LANES (the
// namespace) and FLEXSPLINE_MOST_LANES before it. Includes nothing but plain declarations.
#include "flexspline/core/column_products.hpp"
#include "flexspline/core/lane_kernels.hpp"

namespace flexspline::FLEXSPLINE_LANES {
namespace {

#include "kernels/lane_integrate.hpp"
#include "kernels/lane_normal.hpp"
#include "kernels/lane_numbers.hpp"
#include "kernels/lane_radau.hpp"
#include "kernels/lane_rate.hpp"
#include "kernels/lane_runge_kutta.hpp"
// after the numbers that it is made of
#include "kernels/column_tiles.hpp"

template <int kLanes>
LaneKernel kernel(LaneFormula formula) {
  return formula == LaneFormula::radau ? integrate_lanes<kLanes, RadauStep<kLanes>>
                                       : integrate_lanes<kLanes, RungeKuttaStep<kLanes>>;
}

}  // namespace

LaneKernel find(LaneFormula formula, int lanes) {
  if (lanes == 2) return kernel<2>(formula);
#if FLEXSPLINE_MOST_LANES >= 4
  if (lanes == 4) return kernel<4>(formula);
#endif
#if FLEXSPLINE_MOST_LANES >= 8
  if (lanes == 8) return kernel<8>(formula);
#endif
  return nullptr;
}

ColumnProducts find_products() { return multiply_columns<FLEXSPLINE_MOST_LANES>; }

}  // namespace flexspline::FLEXSPLINE_LANES
