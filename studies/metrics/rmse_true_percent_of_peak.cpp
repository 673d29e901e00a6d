#include "flexspline/studies/metric.hpp"

namespace flexspline::studies {

MetricRow describe_rmse_true_percent_of_peak() {
  return {.id = "rmse_true_percent_of_peak",
          .meaning = "the same in percent of the noise-free peak",
          .unit = MetricUnit::percent,
          .compute = [](const ComparedSeries& s) {
            return 100.0 * compared_rms(s, s.simulated, s.truth) / compared_peak(s, s.truth);
          }};
}

}  // namespace flexspline::studies
