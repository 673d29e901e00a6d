#pragma once

#include <memory>
#include <span>
#include <vector>

#include "flexspline/core/error.hpp"
#include "flexspline/core/ode_system.hpp"

namespace flexspline {

/// A measured signal as an input of an integration: the cubic through its samples that rises where
/// they rise and falls where they fall (Fritsch and Butland 1984), so it never overshoots a sample.
/// Continuous with its slope; third order where the signal is monotone, second at its extremes;
/// held constant beyond the ends.
class MonotoneInput {
 public:
  /// Errors: bad_data for fewer than four samples, times that do not increase, values not finite.
  static Result<MonotoneInput> through(std::span<const double> time, std::span<const double> value);

  double value(double t) const;
  double slope(double t) const;

 private:
  struct Cubic;
  explicit MonotoneInput(std::shared_ptr<const Cubic> cubic) : cubic_(std::move(cubic)) {}
  std::shared_ptr<const Cubic> cubic_;
};

/// Errors of a measured input: independent from sample to sample.
struct InputNoise {
  double deviation = 0.0;  ///< standard, of one sample, in the input's unit
  double interval = 0.0;   ///< s between samples
};

/// How far the states of y' = F(t, y; p) depend on the noise of an input whose error adds to
/// parameter `input`: the variance of each state, [instant][state], from a known initial state, by
/// the linearised equation P' = F_y P + P F_y^T + F_u F_u^T deviation^2 interval. Holds for noise
/// small against the curvature of F and a system slow against the interval; coloured noise and
/// offsets are not modelled (an offset is a parameter: use its sensitivity).
/// Errors: numerics, with the time and the state reached.
Result<std::vector<double>> input_sensitivity(const OdeSystem& system, std::span<const double> p,
                                              std::size_t input, const InputNoise& noise,
                                              std::span<const double> times,
                                              std::span<const double> initial,
                                              const SystemSettings& settings);

}  // namespace flexspline
