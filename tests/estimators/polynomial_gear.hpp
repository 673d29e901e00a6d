#pragma once

#include <cmath>
#include <memory>
#include <numbers>
#include <random>

#include "flexspline/estimators/ode_fit.hpp"
#include "flexspline/estimators/polynomial_torsion.hpp"

namespace flexspline::estimators {

inline constexpr PolynomialTorsionShape kGearShape{};

/// Torque of three recordings of two periods each, one after another: sines of 1, 0.7 and 1 of the
/// peak at 1, 1.6 and 0.5 rad/s, each zero where it starts.
struct Recordings {
  static constexpr double kAmplitude[] = {1.0, 0.7, 1.0};
  static constexpr double kOmega[] = {1.0, 1.6, 0.5};
  static double length(std::size_t r) { return 4.0 * std::numbers::pi / kOmega[r]; }
  static double start(std::size_t r) {
    double at = 0.0;
    for (std::size_t k = 0; k < r; ++k) at += length(k);
    return at;
  }
  static double torque(double t) {
    std::size_t r = 0;
    while (r < 2 && t >= start(r + 1)) ++r;
    return kAmplitude[r] * std::sin(kOmega[r] * (t - start(r)));
  }
};

/// f = (1 - a) x + a x^3 (peak torque at x = 1), g stiff or soft, h by up to 1.8.
inline std::vector<double> random_truth(unsigned seed) {
  std::mt19937_64 engine(seed);
  const auto uniform = [&](double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(engine);
  };
  const double a = uniform(0.1, 0.7);
  const double scale = uniform(0.6, 1.5);
  const double g = std::exp(uniform(std::log(0.8), std::log(6.0)));
  return {scale * (1.0 - a), scale * a, g, g * uniform(-0.25, 2.0), uniform(-0.6, 0.6)};
}

/// Samples of the truth with noise, fitted from f = x, g = 2 z, h = 1.
inline OdeFitProblem gear_recordings(const std::vector<double>& truth, double noise, unsigned seed,
                                     int per_recording = 60) {
  OdeFitProblem problem;
  problem.system = std::make_shared<PolynomialTorsion>(kGearShape, Recordings::torque);
  problem.parameters = {{.name = "f1", .start = 1.0},
                        {.name = "f2", .start = 0.0, .scale = 0.3},
                        {.name = "g1", .start = 2.0},
                        {.name = "g2", .start = 0.0},
                        {.name = "h1", .start = 0.0, .scale = 0.3}};
  problem.state_scale = {1.0};
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal(0.0, noise);
  SystemSettings settings;
  settings.relative_tolerance = 1e-10;
  for (std::size_t r = 0; r < 3; ++r) {
    OdeExperiment experiment{.id = "recording " + std::to_string(r + 1)};
    experiment.start_time = Recordings::start(r);
    experiment.initial = {0.0};
    std::vector<double> times = {experiment.start_time};
    // Short of the end, where the next recording's torque begins.
    for (int k = 1; k <= per_recording; ++k) {
      times.push_back(experiment.start_time + 0.9999 * Recordings::length(r) * k / per_recording);
    }
    const auto run = integrate_system(*problem.system, truth, times, std::vector{0.0}, settings);
    for (std::size_t k = 1; k < times.size(); ++k) {
      experiment.times.push_back(times[k]);
      experiment.measured.push_back(run ? run->state[k] + normal(engine) : kNotComputed);
    }
    experiment.sigma = {noise};
    problem.experiments.push_back(std::move(experiment));
  }
  return problem;
}

}  // namespace flexspline::estimators
