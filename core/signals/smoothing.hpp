#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "flexspline/core/error.hpp"
#include "flexspline/core/resolution.hpp"

namespace flexspline {

/// A second derivative that is smoothed further: noise grows with the fifth power of a bandwidth
/// in its variance, with the first in that of the value.
struct NarrowerSecond {
  std::vector<double> second, error;  ///< and its standard deviation, by sample
  double bandwidth = 0.0;             ///< rad/s
};

/// A smooth signal and its first two derivatives at the instants of its samples.
struct SmoothSignal {
  std::vector<double> value;
  std::vector<double> rate;
  std::vector<double> second;
  double noise = 0.0;           ///< standard deviation of the samples, by what smoothing left of it
  std::vector<double> error{};  ///< of value: noise sqrt(degrees of freedom / samples)
  /// rad/s: of a sine of w the share 1/(1 + (w/bandwidth)^6) is kept; of a spline.
  double bandwidth = std::numeric_limits<double>::infinity();
  /// Standard deviations by sample: of noise, of most of what smoothing took, of what turns too
  /// fast for the samples. The larger of a change where the penalty is a ninth and half the
  /// difference between odd and even samples, rms within 1/bandwidth; of a spline. Of white noise
  /// that of second is 1.76 times its own.
  std::vector<double> value_error{}, rate_error{}, second_error{};
  std::vector<NarrowerSecond> narrower{};  ///< as many as were asked for
};

/// Whether signals can be smoothed: 16 samples or more over a time that increases, and squares that
/// neither are nor sum to infinity. Errors: numerics.
Result<void> check_samples(std::span<const double> time,
                           std::span<const std::span<const double>> signals);

/// Penalised cubic spline (Eilers and Marx 1996, third differences), the penalty by generalised
/// cross-validation with a stochastic trace. Even: a knot for three samples, 3000 at most. Fine:
/// one for each, 20 000 at most, and a degree of freedom costs 1.1. Of an encoder's counts no less
/// is left than counting does (deviation_of_counts). narrower: by what the bandwidths of further
/// second derivatives are divided, and by what their knots are farther apart. Errors: those
/// of check_samples.
Result<SmoothSignal> smooth_by_spline(std::span<const double> time, std::span<const double> samples,
                                      Resolution resolution = Resolution::even,
                                      std::span<const double> narrower = {});

/// The same of several signals sampled at the same instants, whose equations are shared.
Result<std::vector<SmoothSignal>> smooth_by_splines(
    std::span<const double> time, std::span<const std::span<const double>> signals,
    Resolution resolution = Resolution::even, std::span<const double> narrower = {});

/// Which harmonics a smooth signal keeps.
enum class Harmonics {
  significant,  ///< order by the Bayesian information criterion, those below four standard errors
                ///< out
  all,          ///< up to the 40th or a sixth of the samples of a cycle: noisier, not biased
};

/// A signal, and what is kept of it.
struct Sampled {
  std::span<const double> samples;
  Harmonics kept;
};

/// Fourier series of the period given, of signals sampled at the same instants that check_samples
/// takes.
std::vector<SmoothSignal> smooth_by_harmonics(std::span<const double> time,
                                              std::span<const Sampled> signals, double period);

}  // namespace flexspline
