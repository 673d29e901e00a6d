#include "flexspline/core/monotone_spline.hpp"

#include <fmt/format.h>

namespace flexspline {
namespace {

Result<std::unique_ptr<Law>> make(const LawSpec& spec) {
  const std::size_t size = spec.knots.size() + 3;
  if (spec.coefficients.size() != size && spec.coefficients.size() != 2 * size) {
    return failure(ErrorCode::bad_data,
                   fmt::format("monotone_spline with {} knots has {} coefficients",
                               spec.knots.size(), spec.coefficients.size()),
                   fmt::format("give {} (odd) or {} (both sides)", size, 2 * size));
  }
  double last = 0.0;
  for (double knot : spec.knots) {
    if (!(knot > last && knot < 1.0)) {
      return failure(ErrorCode::bad_data,
                     fmt::format("monotone_spline has the knot {} after {}", knot, last),
                     "knots increase inside (0, 1)");
    }
    last = knot;
  }
  return std::make_unique<MonotoneSpline>(spec);
}

}  // namespace

LawRow describe_monotone_spline() {
  return {.id = "monotone_spline",
          .equation = "y = +-sum_i a_i I_i(|x|/s), I_i integrated quadratic B-splines, a_i > 0",
          .range = "increasing everywhere; linear beyond |x| = s",
          .source = "Ramsay, Monotone regression splines in action, Stat. Sci. 3(4), 1988",
          .make = make};
}

}  // namespace flexspline
