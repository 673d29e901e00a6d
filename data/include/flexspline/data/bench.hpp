#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "flexspline/core/effect.hpp"
#include "flexspline/core/error.hpp"
#include "flexspline/core/recording.hpp"

namespace flexspline::data {

/// The truth behind a virtual recording: the paper's locked-rotor bench, with physics of its own
/// that no estimator shares. Arguments and values in SI (rad, rad/s, Nm).
struct BenchTruth {
  std::function<double(double)> stiffness;               ///< f(phi)
  std::function<double(double)> damping;                 ///< g^-1(phi'/h)
  std::function<double(double)> log_modulation;          ///< ln h(phi); ln h(0) = 0
  std::vector<std::pair<double, double>> slip_elements;  ///< Maxwell: stiffness Nm/rad, yield rad
  double inertia = 0.0;                                  ///< Nm s2/rad, beyond the model
  double sensor_lag_s = 0.0;                             ///< torque is late against the angle
  /// Order k, (share, phase in rad): share cos(k (2 pi f t - pi/2) + phase) beside sin(2 pi f t).
  std::vector<std::pair<int, std::pair<double, double>>> harmonics;
};

/// A row of the catalogue of truths. A truth with slip elements has no g^-1 and h to compare with.
struct TruthRow {
  std::string_view id;
  std::string_view summary;
  std::string_view source;
  BenchTruth (*make)();
};

/// Every truth, one file each in data/bench/truths.
std::span<const TruthRow> truths();

/// Errors: usage, with every id there is.
Result<const TruthRow*> find_truth(std::string_view id);

/// How well the six slip elements of the rate-independent truths reproduce the half height of Table
/// I's loop (its g^-1) at 0.2 deg, 0.005 Hz: rms over 199 instants of half a cycle, percent of the
/// largest half height. About 0.44.
double slip_fit_misfit_percent();

/// A sine held by the position loop, started from rest: phi = A r(t) sin(2 pi f t), r a smooth ramp
/// over the first half cycle. Every later cycle repeats exactly, slip elements included.
struct BenchExcitation {
  double amplitude = 0.0;  ///< rad at the output
  double frequency_hz = 0.0;
  int cycles = 5;  ///< the first of them runs up from rest
  int samples_per_cycle = 500;
};

/// How the bench measures.
struct BenchSensors {
  double encoder_step = 0.0;           ///< rad at the motor shaft; 0: not quantised
  double angle_noise = 0.0;            ///< rms, share of the paper's amplitude (0.2 deg)
  double torque_noise_white = 0.0;     ///< rms, share of the paper's peak torque
  double torque_noise_coloured = 0.0;  ///< rms of a first-order process, share of the same
  double torque_noise_samples = 20;    ///< its correlation, in samples
  double time_jitter = 0.0;            ///< rms of the time stamps about the true instants, share of
                                       ///< the sampling step, cut at 0.45 of it
  double missing_samples = 0.0;        ///< share of the samples that are not in the table
};

/// A virtual recording with what only the bench knows.
struct BenchRecording {
  Recording measured;
  Motion motion;               ///< true phi, phi', phi''
  std::vector<double> torque;  ///< true transmitted torque as an ideal sensor would show it
};

/// A truth with its parts multiplied: "stiffness" f, "damping" g^-1, "modulation" ln h, "slip" the
/// slip elements, "harmonics", "inertia", "sensor_lag"; 1 is as the truth has it.
/// Errors: usage, with the nearest name, for another part or a factor that is negative or no
/// number.
Result<BenchTruth> strengthened(BenchTruth truth, const std::map<std::string, double>& strength);

/// Makes one recording. The seed is counter-based: the same (seed, id) gives the same bytes in any
/// order and on any number of workers. The random bits are the same on every platform, the numbers
/// up to the last digit of its sin, cos, exp and log. Samples lie at k / (f samples_per_cycle).
/// Errors: usage for a setting out of its range, numerics where the truth is not finite.
Result<BenchRecording> make_recording(const BenchTruth& truth, const BenchExcitation& excitation,
                                      const BenchSensors& sensors, std::uint64_t seed,
                                      std::string id);

/// The paper's bench around recordings: rig locked, gear ratio 50, Table II.
RecordingSet paper_bench(std::string name, std::vector<Recording> recordings);

}  // namespace flexspline::data
