#pragma once

#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "flexspline/core/effect_path.hpp"

namespace flexspline {

inline const EffectRow& row_of(std::string_view id) {
  const auto row = find_effect(id);
  EXPECT_TRUE(row) << id;
  return **row;
}

/// The term of a static effect.
inline double term(std::string_view id, const std::vector<double>& p, const Instant<double>& x) {
  const EffectRow& row = row_of(id);
  EXPECT_EQ(p.size() % row.parameters.size(), 0u) << id;
  return row.real.term(x, p, {});
}

inline Instant<double> at_speed(double w) {
  Instant<double> x;
  x.motor_speed = w;
  x.gear_ratio = 50.0;
  return x;
}

inline Instant<double> loaded(double w, double torque, double motor_torque = 0.0) {
  Instant<double> x = at_speed(w);
  x.transmitted_torque = torque;
  x.motor_torque = motor_torque;
  return x;
}

/// Constant speed from rest at angle 0, one instant every dt.
inline std::vector<Instant<double>> steady_run(double w, double dt, int samples) {
  std::vector<Instant<double>> path;
  for (int i = 0; i <= samples; ++i) {
    Instant<double> x = at_speed(w);
    x.time = dt * i;
    x.motor_angle = w * x.time;
    path.push_back(x);
  }
  return path;
}

inline std::vector<double> along(std::string_view id, const std::vector<double>& values,
                                 const std::vector<Instant<double>>& path) {
  const EffectRow& row = row_of(id);
  EffectSpec spec{std::string(id), {}};
  for (std::size_t k = 0; k < values.size(); ++k) {
    const auto name = row.parameters[k % row.parameters.size()].name;
    spec.parameters.emplace_back(std::string(name), values[k]);
  }
  const auto terms = terms_along(row, spec, path);
  EXPECT_TRUE(terms) << terms.error().message();
  return terms.value_or(std::vector<double>(path.size(), std::nan("")));
}

}  // namespace flexspline
