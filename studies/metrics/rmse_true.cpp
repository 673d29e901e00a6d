#include "flexspline/studies/metric.hpp"

namespace flexspline::studies {

MetricRow describe_rmse_true() {
  return {.id = "rmse_true",
          .meaning = "root mean square of simulated minus the bench's noise-free torque (force)",
          .unit = MetricUnit::effort,
          .compute = [](const ComparedSeries& s) { return compared_rms(s, s.simulated, s.truth); }};
}

}  // namespace flexspline::studies
