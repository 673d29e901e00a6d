#include "flexspline/studies/metric.hpp"

namespace flexspline::studies {

MetricRow describe_rmse_percent_of_peak() {
  return {.id = "rmse_percent_of_peak",
          .meaning = "the same in percent of the recording's measured peak",
          .unit = MetricUnit::percent,
          .compute = [](const ComparedSeries& s) {
            return 100.0 * compared_rms(s, s.simulated, s.measured) / compared_peak(s, s.measured);
          }};
}

}  // namespace flexspline::studies
