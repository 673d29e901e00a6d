#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace flexspline {

/// A smooth signal and its first two derivatives at the instants of its samples.
struct SmoothSignal {
  std::vector<double> value;
  std::vector<double> rate;
  std::vector<double> second;
  double noise = 0.0;  ///< standard deviation of sample minus value
  std::vector<double> error{};  ///< of value: noise sqrt(degrees of freedom / samples)
};

/// Penalised cubic spline (Eilers and Marx 1996, third differences), the penalty by generalised
/// cross-validation with a stochastic trace. 16 samples or more.
SmoothSignal smooth_by_spline(std::span<const double> time, std::span<const double> samples);

/// Fourier series of the period given; order by the Bayesian information criterion, harmonics below
/// four standard errors left out.
SmoothSignal smooth_by_harmonics(std::span<const double> time, std::span<const double> samples,
                                 double period);

}  // namespace flexspline
