#include "comparison/decimate.hpp"

#include <algorithm>

namespace flexspline::studies {

std::vector<std::size_t> kept_indices(std::size_t first, std::size_t last) {
  std::vector<std::size_t> indices;
  if (last <= first) return indices;
  const std::size_t count = last - first;
  const std::size_t kept = std::min(count, kKeptPoints);
  for (std::size_t i = 0; i < kept; ++i) {
    indices.push_back(first + (kept == 1 ? 0 : i * (count - 1) / (kept - 1)));
  }
  return indices;
}

std::vector<double> at_indices(std::span<const double> series,
                               std::span<const std::size_t> indices) {
  std::vector<double> kept;
  kept.reserve(indices.size());
  for (const std::size_t index : indices) kept.push_back(series[index]);
  return kept;
}

}  // namespace flexspline::studies
