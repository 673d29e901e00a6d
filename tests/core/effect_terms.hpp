#pragma once

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "effect_paths.hpp"
#include "flexspline/core/effect_path.hpp"

namespace flexspline {

inline constexpr double kPi = std::numbers::pi;
using Path = std::vector<Instant<double>>;

/// What an effect adds at its site along a path.
inline std::vector<double> terms_of(const std::string& id, const Parameters& parameters,
                                    const Path& path) {
  const auto row = find_effect(id);
  EXPECT_TRUE(row);
  const auto along = terms_along(**row, {id, parameters}, path);
  EXPECT_TRUE(along);
  return along.value_or(std::vector<double>(path.size(), std::nan("")));
}

inline double term_at(const std::string& id, const Parameters& parameters,
                      const Instant<double>& x) {
  return terms_of(id, parameters, {x}).front();
}

/// A path in which one quantity takes these values, a second apart.
inline Path along(double Instant<double>::*member, const std::vector<double>& values) {
  Path path(values.size());
  for (std::size_t i = 0; i < path.size(); ++i) {
    path[i].time = static_cast<double>(i);
    path[i].*member = values[i];
  }
  return path;
}

/// sum of y dx, trapezoids.
inline double integral(const std::vector<double>& y, const std::vector<double>& x) {
  double sum = 0.0;
  for (std::size_t i = 1; i < x.size(); ++i) sum += 0.5 * (y[i] + y[i - 1]) * (x[i] - x[i - 1]);
  return sum;
}

inline std::vector<double> grid(double from, double to, int steps) {
  std::vector<double> values;
  for (int i = 0; i <= steps; ++i) values.push_back(from + (to - from) * i / steps);
  return values;
}

}  // namespace flexspline
