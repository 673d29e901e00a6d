#include <algorithm>
#include <cmath>

#include "flexspline/studies/trial.hpp"

namespace flexspline::studies {

Proportion proportion(int count, int of) {
  expects(count >= 0 && count <= of, "successes are among the trials");
  constexpr double kNormal = 1.959963984540054;  // its 97.5 % quantile
  Proportion result{count, of, 0.0, 1.0};
  if (of == 0) return result;
  const double n = of;
  const double share = result.rate();
  const double z2 = kNormal * kNormal / n;
  const double centre = (share + 0.5 * z2) / (1.0 + z2);
  const double half = kNormal * std::sqrt(share * (1.0 - share) / n + 0.25 * z2 / n) / (1.0 + z2);
  result.lower = count == 0 ? 0.0 : std::max(0.0, centre - half);
  result.upper = count == of ? 1.0 : std::min(1.0, centre + half);
  return result;
}

}  // namespace flexspline::studies
