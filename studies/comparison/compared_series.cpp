#include <algorithm>
#include <cmath>

#include "flexspline/studies/metric.hpp"

namespace flexspline::studies {

double compared_rms(const ComparedSeries& series, std::span<const double> a,
                    std::span<const double> b) {
  if (a.size() != b.size() || a.size() != series.counts.size()) return kNotComputed;
  double sum = 0.0;
  double count = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!series.counts[i]) continue;
    sum += (a[i] - b[i]) * (a[i] - b[i]);
    count += 1.0;
  }
  return count > 0.0 ? std::sqrt(sum / count) : kNotComputed;
}

double compared_peak(const ComparedSeries& series, std::span<const double> signal) {
  if (signal.size() != series.counts.size()) return kNotComputed;
  double peak = 0.0;
  for (std::size_t i = 0; i < signal.size(); ++i) {
    if (series.counts[i]) peak = std::max(peak, std::abs(signal[i]));
  }
  return peak > 0.0 ? peak : kNotComputed;
}

double cycle_area(const ComparedSeries& series, std::span<const double> effort) {
  const std::size_t first = series.cycle_first;
  const std::size_t last = series.cycle_last;
  if (last < first + 3 || last > effort.size()) return kNotComputed;
  double area = 0.0;
  for (std::size_t i = first; i < last; ++i) {
    const std::size_t next = i + 1 < last ? i + 1 : first;
    area += 0.5 * (effort[i] + effort[next]) * (series.motion[next] - series.motion[i]);
  }
  return std::abs(area);
}

}  // namespace flexspline::studies
