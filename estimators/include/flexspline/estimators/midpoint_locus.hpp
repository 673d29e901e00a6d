#pragma once

#include <vector>

#include "flexspline/core/error.hpp"
#include "flexspline/core/recording.hpp"

namespace flexspline::estimators {

/// The midpoint locus of one loop, Dhaouadi and Ghorbel (2003), eqs. (15)-(19): at two instants of
/// equal phi and opposite phi', Xm = (tau1 + tau2)/2 lies on f and Xd = (tau1 - tau2)/2 on g^-1.
/// phi and phi' are those of a pure sine (their fig. 7), not the measured ones.
struct MidpointLocus {
  std::vector<double> motion{};    ///< rad (m), about the middle of the loop
  std::vector<double> midpoint{};  ///< Xm, Nm (N)
  std::vector<double> rate{};      ///< rad/s (m/s), positive
  std::vector<double> distance{};  ///< Xd, Nm (N)
  double amplitude = 0.0;
  double angular_frequency = 0.0;
  double phase = 0.0;   ///< motion = centre + amplitude cos(w t + phase)
  double centre = 0.0;  ///< middle of the motion
  double purity = 0.0;  ///< share of the motion's variance that the sine explains
  int cycles = 0;       ///< averaged over
};

/// Errors: numerics, where the motion does not repeat or is no sine (less than 80 % explained).
Result<MidpointLocus> midpoint_locus(const TorsionRecord& record);

}  // namespace flexspline::estimators
