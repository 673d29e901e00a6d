#include "flexspline/studies/metric.hpp"

namespace flexspline::studies {

MetricRow describe_rmse() {
  return {
      .id = "rmse",
      .meaning = "root mean square of simulated minus measured torque (force)",
      .unit = MetricUnit::effort,
      .compute = [](const ComparedSeries& s) { return compared_rms(s, s.simulated, s.measured); }};
}

}  // namespace flexspline::studies
