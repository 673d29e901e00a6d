#include "answers/sobol_indices.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <random>

#include "config/sweep_design.hpp"

namespace flexspline::studies {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr int kLevels = 4;
constexpr double kDelta = kLevels / (2.0 * (kLevels - 1));
constexpr std::size_t kBlocks = 10;

/// Sums over samples of one parameter's index, from which blocks can be taken away again.
struct Sums {
  double count = 0.0, f = 0.0, f2 = 0.0, first = 0.0, total = 0.0;

  void add(double a, double b, double ab) {
    count += 1.0;
    f += a + b;
    f2 += a * a + b * b;
    first += b * (ab - a);
    total += (a - ab) * (a - ab);
  }
  Sums without(const Sums& other) const {
    return {count - other.count, f - other.f, f2 - other.f2, first - other.first,
            total - other.total};
  }
  double variance() const {
    const double mean = f / (2.0 * count);
    return f2 / (2.0 * count) - mean * mean;
  }
  double first_index() const { return first / count / variance(); }
  double total_index() const { return total / (2.0 * count) / variance(); }
};

double jackknife_std(const std::vector<double>& left_out) {
  const auto n = static_cast<double>(left_out.size());
  const double mean = std::accumulate(left_out.begin(), left_out.end(), 0.0) / n;
  double sum = 0.0;
  for (const double one : left_out) sum += (one - mean) * (one - mean);
  return std::sqrt((n - 1.0) / n * sum);
}

SobolIndex index_of(const std::vector<Sums>& blocks) {
  Sums all;
  for (const Sums& one : blocks)
    all = all.without({-one.count, -one.f, -one.f2, -one.first, -one.total});
  if (!(all.count > 1.0) || !(all.variance() > 0.0)) return {kNaN, kNaN, kNaN, kNaN};
  std::vector<double> first, total;
  for (const Sums& one : blocks) {
    first.push_back(all.without(one).first_index());
    total.push_back(all.without(one).total_index());
  }
  return {all.first_index(), all.total_index(), jackknife_std(first), jackknife_std(total)};
}

}  // namespace

std::vector<std::vector<double>> saltelli_design(std::size_t n, std::size_t dimensions) {
  const auto points = sobol_points(n, 2 * dimensions);
  std::vector<std::vector<double>> rows;
  rows.reserve(n * (dimensions + 2));
  const auto half = static_cast<std::ptrdiff_t>(dimensions);
  for (const auto& p : points) rows.emplace_back(p.begin(), p.begin() + half);
  for (const auto& p : points) rows.emplace_back(p.begin() + half, p.end());
  for (std::size_t i = 0; i < dimensions; ++i) {
    for (std::size_t k = 0; k < n; ++k) {
      rows.push_back(rows[k]);
      rows.back()[i] = points[k][dimensions + i];
    }
  }
  return rows;
}

std::vector<std::vector<double>> morris_design(std::size_t trajectories, std::size_t dimensions,
                                               unsigned long seed) {
  std::mt19937_64 bits(seed);
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>((bits() >> 11U) % n); };
  std::vector<std::vector<double>> rows;
  for (std::size_t t = 0; t < trajectories; ++t) {
    std::vector<double> at(dimensions);
    // A base from which every step of delta stays within the cube, up or down.
    for (double& x : at) x = static_cast<double>(below(kLevels)) / (kLevels - 1);
    std::vector<std::size_t> order(dimensions);
    std::iota(order.begin(), order.end(), std::size_t{0});
    for (std::size_t i = dimensions; i > 1; --i) std::swap(order[i - 1], order[below(i)]);
    rows.push_back(at);
    for (const std::size_t i : order) {
      at[i] += at[i] + kDelta <= 1.0 + 1e-9 ? kDelta : -kDelta;
      rows.push_back(at);
    }
  }
  return rows;
}

std::vector<SobolIndex> sobol_indices(const std::vector<double>& values, std::size_t dimensions) {
  const std::size_t n = values.size() / (dimensions + 2);
  std::vector<SobolIndex> indices;
  std::vector<bool> whole(n, true);
  for (std::size_t at = 0; at < values.size(); ++at) {
    if (std::isnan(values[at])) whole[at % n] = false;
  }
  // About their mean: a constant is no part of any index, and much of its estimate's noise.
  Sums plain;
  for (std::size_t k = 0; k < n; ++k) {
    if (whole[k]) plain.add(values[k], values[n + k], values[k]);
  }
  const double mean = plain.f / (2.0 * std::max(1.0, plain.count));
  for (std::size_t i = 0; i < dimensions; ++i) {
    std::vector<Sums> blocks(kBlocks);
    for (std::size_t k = 0; k < n; ++k) {
      if (!whole[k]) continue;
      blocks[k * kBlocks / n].add(values[k] - mean, values[n + k] - mean,
                                  values[(2 + i) * n + k] - mean);
    }
    indices.push_back(index_of(blocks));
  }
  return indices;
}

std::vector<MorrisEffect> morris_effects(const std::vector<std::vector<double>>& design,
                                         const std::vector<double>& values,
                                         std::size_t dimensions) {
  std::vector<std::vector<double>> effects(dimensions);
  for (std::size_t row = 0; row + 1 < design.size(); ++row) {
    if ((row + 1) % (dimensions + 1) == 0) continue;  // the next trajectory begins
    for (std::size_t i = 0; i < dimensions; ++i) {
      const double step = design[row + 1][i] - design[row][i];
      const double effect = (values[row + 1] - values[row]) / step;
      if (step != 0.0 && std::isfinite(effect)) effects[i].push_back(effect);
    }
  }
  std::vector<MorrisEffect> found;
  for (const auto& list : effects) {
    const auto n = static_cast<double>(list.size());
    MorrisEffect one;
    for (const double effect : list) {
      one.mean += effect / n;
      one.mean_abs += std::abs(effect) / n;
    }
    for (const double effect : list) one.deviation += (effect - one.mean) * (effect - one.mean);
    one.deviation = n > 1.0 ? std::sqrt(one.deviation / (n - 1.0)) : kNaN;
    if (list.empty()) one = {kNaN, kNaN, kNaN};
    found.push_back(one);
  }
  return found;
}

}  // namespace flexspline::studies
