#pragma once

#include <cmath>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "diagnosis/frame/frame.hpp"
#include "flexspline/studies/conceal.hpp"

namespace flexspline::studies {

/// Normal noise of unit variance.
inline Eigen::ArrayXd normal(Eigen::Index rows, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> one;
  return Eigen::ArrayXd::NullaryExpr(rows, [&] { return one(random); });
}

/// The measured recordings of a bench drawn from a seed, and what it hides.
inline ConcealedCase drawn_case(data::BenchKind rig, std::uint64_t seed,
                                std::vector<data::HiddenEffect> effects = {}) {
  ConcealPlan plan;
  plan.rig = rig;
  plan.seed = seed;
  plan.effects = std::move(effects);
  auto made = conceal(plan);
  EXPECT_TRUE(made.has_value()) << (made ? "" : made.error().message());
  return made ? *std::move(made) : ConcealedCase{};
}

inline Frame drawn_frame(Rig rig, std::uint64_t seed = 3) {
  auto frame = make_frame(drawn_case(rig, seed).recordings, 4000);
  EXPECT_TRUE(frame.has_value()) << (frame ? "" : frame.error().message());
  return frame ? *std::move(frame) : Frame{};
}

/// A sum of three sines with its rates.
struct Wave {
  Eigen::ArrayXd value, rate, acceleration;
};

inline Wave wave(const Eigen::ArrayXd& t, double amplitude, double frequency) {
  Wave w{0.0 * t, 0.0 * t, 0.0 * t};
  const double shares[] = {0.6, 0.3, 0.2};
  const double factors[] = {1.0, 2.3, 3.7};
  for (int k = 0; k < 3; ++k) {
    const double a = amplitude * shares[k];
    const double omega = frequency * factors[k];
    const Eigen::ArrayXd phase = omega * t + k;
    w.value += a * phase.sin();
    w.rate += a * omega * phase.cos();
    w.acceleration -= a * omega * omega * phase.sin();
  }
  return w;
}

/// A free drive of ratio 50 whose load swings through several turns of the motor, in closed form:
/// every rate is that of its angle. Two recordings of different speed.
inline Frame closed_form_frame(Eigen::Index rows = 6000, double interval = 2e-3) {
  Frame f;
  f.rig = Rig::free;
  f.ratio = 50.0;
  f.motor_inertia = 3e-5;
  f.load_inertia = 1.0;
  f.equations = {Equation::torsion, Equation::load, Equation::motor};
  const Eigen::Index half = rows / 2;
  f.segments = {{"slow", 0, half, Split::unassigned}, {"fast", half, half, Split::unassigned}};
  f.time = Eigen::ArrayXd::LinSpaced(half, 0.0, interval * static_cast<double>(half - 1))
               .replicate(2, 1);
  f.clock = f.time;
  f.clock.tail(half) += 100.0;
  Eigen::ArrayXd phase_time = f.time;
  phase_time.tail(half) = 1.7 * f.time.tail(half) + 3.0;
  const auto put = [&](const Wave& w, Eigen::ArrayXd& x, Eigen::ArrayXd& v, Eigen::ArrayXd& a) {
    x = w.value, v = w.rate, a = w.acceleration;
    v.tail(half) *= 1.7, a.tail(half) *= 1.7 * 1.7;
  };
  put(wave(phase_time, 0.8, 2.1), f.load_angle, f.load_speed, f.load_acceleration);
  put(wave(phase_time, 2e-3, 3.3), f.torsion, f.torsion_rate, f.torsion_acceleration);
  f.motor_angle = f.ratio * (f.torsion + f.load_angle);
  f.motor_speed = f.ratio * (f.torsion_rate + f.load_speed);
  f.motor_acceleration = f.ratio * (f.torsion_acceleration + f.load_acceleration);
  Eigen::ArrayXd unused;
  put(wave(phase_time, 40.0, 1.4), f.torque, f.torque_rate, unused);
  f.smooth_torque = f.told_torque = f.torque;
  put(wave(phase_time, 1.2, 1.9), f.motor_torque, f.motor_torque_rate, unused);
  f.smooth_motor_torque = f.motor_torque;
  f.usable = Eigen::ArrayXd::Ones(2 * half);
  f.measure_torsion();
  f.speed_range = f.motor_speed.abs().maxCoeff();
  f.torque_range = f.torque.abs().maxCoeff();
  f.duration = f.time.maxCoeff();
  f.interval = interval;
  f.session = f.clock.maxCoeff();
  return f;
}

}  // namespace flexspline::studies
