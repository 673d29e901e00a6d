#include "ode_fit/home_rate.hpp"

#include <boost/math/distributions/binomial.hpp>

namespace flexspline::estimators {

HomeRate home_rate(int home, int starts) {
  using Binomial = boost::math::binomial_distribution<>;
  const double n = starts;
  const double k = home;
  return {k / n, Binomial::find_lower_bound_on_p(n, k, 0.025),
          Binomial::find_upper_bound_on_p(n, k, 0.025)};
}

}  // namespace flexspline::estimators
