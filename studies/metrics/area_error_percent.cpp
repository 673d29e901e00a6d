#include "flexspline/studies/metric.hpp"

namespace flexspline::studies {

MetricRow describe_area_error_percent() {
  return {.id = "area_error_percent",
          .meaning = "simulated loop area against the noise-free (else the measured) one",
          .unit = MetricUnit::percent,
          .compute = [](const ComparedSeries& s) {
            const double known = cycle_area(s, s.truth.empty() ? s.measured : s.truth);
            return 100.0 * (cycle_area(s, s.simulated) - known) / known;
          }};
}

}  // namespace flexspline::studies
