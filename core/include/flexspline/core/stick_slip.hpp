#pragma once

#include <functional>
#include <span>
#include <vector>

#include "flexspline/core/error.hpp"
#include "flexspline/core/ode_system.hpp"

namespace flexspline {

/// A drive with one degree of freedom and dry friction, J v' = effort(t, x) - B v - F, x' = v.
/// Slipping, F = sgn(v) (Fc + (Fs - Fc) exp(-(v / vs)^2)); sticking, v = 0 and F balances the
/// effort as long as that is at most Fs. SI, in one frame (rotation or translation). Not modelled:
/// presliding displacement and frictional lag (see the effects of memory for those).
struct DryFrictionDrive {
  double inertia = 1.0;         ///< J > 0
  double viscous = 0.0;         ///< B >= 0
  double sliding_level = 0.0;   ///< Fc >= 0
  double static_level = 0.0;    ///< Fs >= Fc
  double stribeck_speed = 0.0;  ///< vs >= 0; 0: friction falls from Fs to Fc at once
  /// Every other torque (force), springs included.
  std::function<double(double t, double x)> effort;
  /// d effort/dx, for Newton's iteration only: without it steps are lost, not accuracy.
  std::function<double(double t, double x)> effort_slope;
};

enum class Contact { slip_backward = -1, stick = 0, slip_forward = 1 };

struct ContactEvent {
  double time = 0.0;
  double position = 0.0;
  Contact from = Contact::stick;
  Contact to = Contact::stick;
};

struct StickSlipSettings {
  double relative_tolerance = 1e-9;
  double position_tolerance = 1e-12;  ///< absolute, in units of x
  double speed_tolerance = 1e-12;     ///< absolute, in units of v
  /// s; an effort that exceeds Fs for less than this may be missed. 0: a hundredth of the time.
  double longest_step = 0.0;
  long max_steps = 2000000;
  std::size_t max_events = 100000;
};

/// Position and speed at the instants asked for.
struct StickSlipTrajectory {
  std::vector<double> position;
  std::vector<double> speed;
  std::vector<Contact> contact;      ///< after an event, at its instant
  std::vector<ContactEvent> events;  ///< in order of time
  double stick_share = 0.0;          ///< of the time from the first to the last instant
  long steps = 0;
};

/// The reference: stick and slip as states of a machine that changes where CVODES finds the root of
/// |effort| - Fs (sticking) or of v (slipping), so the events are exact to the tolerance.
/// Errors: bad_data for a drive outside its ranges; numerics with the time and the state reached.
Result<StickSlipTrajectory> simulate_stick_slip(const DryFrictionDrive& drive,
                                                std::span<const double> times, double position,
                                                double speed,
                                                const StickSlipSettings& settings = {});

/// The same drive with tanh(v / width) for sgn(v), and by how much that is wrong. With Fs = Fc the
/// error falls in proportion to the width (a locked rotor: 3.8, 0.82, 0.09 % of the position range
/// at 0.17, 0.017, 0.0017 of the speed range). With Fs = 1.3 Fc falling at once (vs = 0, smoothed
/// as ten widths) it does not: 12.7, 8.8, 6.4 %, because the smoothed friction never reaches Fs.
/// With a Stribeck speed it converges once the width is far below that speed: 18, 4.4, 0.9 % at
/// 0.1, 0.01, 0.001 of it. Where it sticks, the smoothed drive creeps at width * atanh(effort /
/// Fs).
struct SmoothedTrajectory {
  std::vector<double> position;
  std::vector<double> speed;
  /// Largest distance from the event-exact position, in parts of the largest event-exact one.
  double error = 0.0;
  long steps = 0;
};

/// Errors: as simulate_stick_slip, which runs beside it for the stated error, and bad_data for a
/// width that is not positive.
Result<SmoothedTrajectory> simulate_smoothed(const DryFrictionDrive& drive, double width,
                                             std::span<const double> times, double position,
                                             double speed, const StickSlipSettings& settings = {});

}  // namespace flexspline
