#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "flexspline/core/estimate.hpp"

namespace flexspline::studies {

/// One recording beside its simulation, sample by sample. SI.
struct ComparedSeries {
  std::vector<double> motion;
  std::vector<double> simulated;
  std::vector<double> measured;
  std::vector<double> truth;    ///< the bench's own noise-free effort; empty for data sets
  std::vector<bool> counts;     ///< samples that are compared
  std::size_t cycle_first = 0;  ///< one steady cycle [first, last); empty where there is none
  std::size_t cycle_last = 0;
};

enum class MetricUnit { effort, percent };

/// A row of the catalogue of metrics: one number a recording.
struct MetricRow {
  std::string_view id;
  std::string_view meaning;
  MetricUnit unit;
  /// NaN where the recording does not give it.
  double (*compute)(const ComparedSeries& series);
};

/// Every metric, one file each in studies/metrics.
std::span<const MetricRow> metrics();

/// rms of a - b over the compared samples; NaN where lengths differ or nothing is compared.
double compared_rms(const ComparedSeries& series, std::span<const double> a,
                    std::span<const double> b);
/// Largest |signal| over the compared samples.
double compared_peak(const ComparedSeries& series, std::span<const double> signal);
/// Effort times motion around the steady cycle, without sign; NaN where there is none.
double cycle_area(const ComparedSeries& series, std::span<const double> effort);

}  // namespace flexspline::studies
