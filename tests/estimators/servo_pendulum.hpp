#pragma once

#include <cmath>

#include "flexspline/estimators/servo_fit.hpp"

namespace flexspline::estimators {

inline ModelSpec friction(double coulomb, double viscous, double load) {
  const LawSpec nothing{.law = "odd_polynomial", .scale = 1.0, .knots = {}, .coefficients = {0.0}};
  return {.f = nothing,
          .g_inverse = nothing,
          .h = {.law = "bounded_modulation", .knots = {}, .coefficients = {}},
          .effects = {{"coulomb_viscous_friction",
                       {{"coulomb", coulomb}, {"viscous", viscous}, {"smoothing", 0.05}}},
                      {"directional_load_friction",
                       {{"motor_share", load},
                        {"load_share", 0.5 * load},
                        {"smoothing", 0.05},
                        {"load_smoothing", 0.01}}}}};
}

inline DriveSpec drive() {
  DriveSpec d;
  d.torsion = friction(0.03, 0.01, 0.1);
  d.load_mass = 0.5;
  d.arm_length = 0.1;
  d.load_inertia = 0.005;
  d.motor_inertia = 0.002;
  d.torque_constant = d.back_emf = 0.4;
  d.resistance = 4.0;
  return d;
}

inline Recording recording(const std::string& id, double amplitude, double omega) {
  Recording one;
  one.id = id;
  std::vector<double> duty;
  std::vector<double> on;
  for (int k = 0; k < 600; ++k) {
    const double t = 0.01 * k;
    one.time.push_back(t);
    duty.push_back(amplitude * (std::sin(omega * t) + 0.4 * std::sin(3.3 * omega * t)));
    on.push_back(t < 4.5 ? 1.0 : 0.0);
  }
  one.channels[Quantity::duty_cycle] = duty;
  one.channels[Quantity::drive_enabled] = on;
  one.channels[Quantity::supply_voltage].assign(one.time.size(), 7.4);
  one.channels[Quantity::load_angle].assign(one.time.size(), 0.0);
  one.channels[Quantity::load_angle] = *simulate_servo(drive(), one, 1e-9);
  return one;
}

inline RecordingSet pendulum() {
  RecordingSet set;
  set.name = "pendulum";
  set.rig = Rig::servo;
  set.constants = {{"load_mass_kg", 0.5}, {"arm_length_m", 0.1}};
  set.recordings = {recording("slow", 0.5, 2.0), recording("fast", 0.8, 5.0),
                    recording("held", 0.6, 3.0)};
  set.recordings.back().split = Split::holdout;
  return set;
}

}  // namespace flexspline::estimators
