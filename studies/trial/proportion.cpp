#include <boost/math/distributions/beta.hpp>

#include "flexspline/studies/trial.hpp"

namespace flexspline::studies {

Proportion proportion(int count, int of) {
  expects(count >= 0 && count <= of, "successes are among the trials");
  constexpr double kTail = 0.025;
  using Beta = boost::math::beta_distribution<double>;
  Proportion result{count, of, 0.0, 1.0};
  if (count > 0) result.lower = boost::math::quantile(Beta(count, of - count + 1.0), kTail);
  if (count < of) {
    result.upper = boost::math::quantile(Beta(count + 1.0, of - count), 1.0 - kTail);
  }
  return result;
}

}  // namespace flexspline::studies
