#include "bench/hidden_differences.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace flexspline::data {

std::vector<double> slopes(const std::vector<double>& values, double step) {
  const std::size_t n = values.size();
  std::vector<double> result(n, 0.0);
  for (std::size_t k = 1; k + 1 < n; ++k)
    result[k] = (values[k + 1] - values[k - 1]) / (2.0 * step);
  result[n - 1] = (1.5 * values[n - 1] - 2.0 * values[n - 2] + 0.5 * values[n - 3]) / step;
  return result;
}

std::vector<double> bends(const std::vector<double>& values, double step) {
  const std::size_t n = values.size();
  std::vector<double> result(n, 0.0);
  for (std::size_t k = 1; k + 1 < n; ++k) {
    result[k] = (values[k + 1] - 2.0 * values[k] + values[k - 1]) / (step * step);
  }
  result[n - 1] = 2.0 * result[n - 2] - result[n - 3];
  return result;
}

double between(const std::vector<double>& values, double place) {
  const double last = static_cast<double>(values.size() - 1);
  if (place <= 0.0) return values.front();
  if (place >= last) return values.back();
  const double start = std::clamp(std::floor(place) - 1.0, 0.0, last - 3.0);
  const auto k = static_cast<std::size_t>(start);
  const double u = place - start;
  const double a = u;
  const double b = u - 1.0;
  const double c = u - 2.0;
  const double d = u - 3.0;
  return -values[k] * b * c * d / 6.0 + values[k + 1] * a * c * d / 2.0 -
         values[k + 2] * a * b * d / 2.0 + values[k + 3] * a * b * c / 6.0;
}

std::vector<double> delayed(const std::vector<double>& values, double late) {
  std::vector<double> result(values.size());
  for (std::size_t k = 0; k < values.size(); ++k) {
    result[k] = between(values, static_cast<double>(k) - late);
  }
  return result;
}

}  // namespace flexspline::data
