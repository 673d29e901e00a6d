#pragma once

#include <vector>

#include "flexspline/core/error.hpp"
#include "flexspline/core/recording.hpp"

namespace flexspline::estimators {

/// Where the speed on the locus comes from: from the sine fitted to the motion, as in the paper
/// (fig. 7), w sqrt(A^2 - (phi - centre)^2); or from the derivative of the measured motion,
/// averaged over the cycles by its Fourier series.
enum class LocusSpeed { pure_sine, measured };

/// The midpoint locus of one loop, Dhaouadi and Ghorbel (2003), eqs. (15)-(19): at two instants of
/// equal phi, one on each branch, Xm = (tau1 + tau2)/2 and Xd = (tau1 - tau2)/2. Where phi' is
/// equal and opposite there, Xm lies on f and Xd on g^-1; else, with an odd g^-1 and h = 1, Xd =
/// [g^-1(v1) + g^-1(v2)]/2 and Xm = f + [g^-1(v1) - g^-1(v2)]/2 with the speeds v1 and v2.
struct MidpointLocus {
  std::vector<double> motion{};        ///< rad (m), from the centre
  std::vector<double> midpoint{};      ///< Xm, Nm (N)
  std::vector<double> rising_rate{};   ///< v1, rad/s (m/s), positive
  std::vector<double> falling_rate{};  ///< v2, rad/s (m/s), positive
  std::vector<double> distance{};      ///< Xd, Nm (N)
  double amplitude = 0.0;
  double angular_frequency = 0.0;
  double phase = 0.0;   ///< of the fitted sine: centre + amplitude cos(w t + phase)
  double centre = 0.0;  ///< mean of the fitted sine
  double purity = 0.0;  ///< share of the motion's variance that the sine explains
  int cycles = 0;       ///< averaged over
};

/// Errors: numerics, where the motion does not repeat, turns more than twice a cycle, or with
/// LocusSpeed::pure_sine is no sine (less than 80 % explained).
Result<MidpointLocus> midpoint_locus(const TorsionRecord& record,
                                     LocusSpeed speed = LocusSpeed::pure_sine);

}  // namespace flexspline::estimators
