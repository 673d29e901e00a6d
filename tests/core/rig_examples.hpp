#pragma once

#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "flexspline/core/rig.hpp"
#include "law_examples.hpp"

namespace flexspline {

/// A stiff 226 Nm gear of ratio 50 with its motor and a load.
inline DriveSpec example_drive() {
  DriveSpec drive;
  drive.torsion.f = law_spec("odd_polynomial", 2e-3, {}, {24.0, 6.0});
  drive.torsion.g_inverse = law_spec("odd_polynomial", 0.05, {}, {3.0, 1.0});
  drive.torsion.h = law_spec("bounded_modulation", 2e-3, {}, {0.1, 0.2});
  drive.gear_ratio = 50.0;
  drive.motor_inertia = 7.26e-4;
  drive.motor_viscous = 6e-4;
  drive.motor_coulomb = 0.03;
  drive.coulomb_width = 2.0;
  drive.load_inertia = 2.9;
  drive.load_viscous = 0.8;
  drive.load_mass = 5.0;
  drive.arm_length = 0.3;
  drive.torque_constant = 0.1;
  drive.resistance = 0.4;
  drive.inductance = 2e-3;
  drive.back_emf = 0.1;
  drive.position_loop = {20.0, 50.0, 0.3, 1e9};
  return drive;
}

inline Signal sine(double amplitude, double frequency_hz, double phase = 0.0) {
  const double w = 2.0 * std::numbers::pi * frequency_hz;
  return {[=](double t) { return amplitude * std::sin(w * t + phase); },
          [=](double t) { return amplitude * w * std::cos(w * t + phase); }};
}

inline Signal constant(double value) {
  return {[=](double) { return value; }, [](double) { return 0.0; }};
}

inline std::vector<double> instants(double end, int count) {
  std::vector<double> times;
  for (int i = 0; i <= count; ++i) times.push_back(end * i / count);
  return times;
}

inline std::unique_ptr<RigSystem> made_rig(Rig rig, const DriveSpec& drive, const RigInputs& inputs,
                                           std::string_view form = {}) {
  auto system = make_rig(rig, drive, inputs, form);
  EXPECT_TRUE(system) << system.error().message();
  return std::move(*system);
}

inline std::vector<double> simulated(const OdeSystem& system, std::span<const double> p,
                                     std::span<const double> times, std::span<const double> initial,
                                     double tolerance, double absolute) {
  SystemSettings settings;
  settings.relative_tolerance = tolerance;
  settings.absolute_tolerance.assign(system.states(), absolute);
  settings.max_steps = 5000000;
  const auto run = integrate_system(system, p, times, initial, settings);
  EXPECT_TRUE(run) << run.error().message();
  return run ? run->state : std::vector<double>(times.size() * system.states(), std::nan(""));
}

}  // namespace flexspline
