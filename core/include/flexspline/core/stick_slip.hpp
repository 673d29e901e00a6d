#pragma once

#include <functional>
#include <span>
#include <vector>

#include "flexspline/core/error.hpp"
#include "flexspline/core/ode_system.hpp"

namespace flexspline {

/// A drive with one degree of freedom and dry friction, J v' = effort(t, x) - B v - F, x' = v.
/// Slipping, F = sgn(v) (Fc + (Fs - Fc) exp(-(v / vs)^2)); sticking, v = 0 and F balances the effort
/// as long as that is at most Fs. SI, in one frame (rotation or translation). Not modelled:
/// presliding displacement and frictional lag (see the effects of memory for those).
struct DryFrictionDrive {
  double inertia = 1.0;           ///< J > 0
  double viscous = 0.0;           ///< B >= 0
  double sliding_level = 0.0;     ///< Fc >= 0
  double static_level = 0.0;      ///< Fs >= Fc
  double stribeck_speed = 0.0;    ///< vs >= 0; 0: friction falls from Fs to Fc at once
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

/// The same drive with tanh(v / width) for sgn(v), and by how much that is wrong.
struct SmoothedTrajectory {
  std::vector<double> position;
  std::vector<double> speed;
  /// Largest distance from the event-exact position, in parts of the largest event-exact one. It
  /// falls in proportion to the width only where Fs = Fc. Where Fs > Fc it need not fall at all:
  /// the smoothed drive creeps where the exact one sticks, passes the peak of friction at another
  /// instant, and each further jump is displaced.
  double error = 0.0;
  long steps = 0;
};

/// Errors: as simulate_stick_slip, and bad_data for a width that is not positive.
Result<SmoothedTrajectory> simulate_smoothed(const DryFrictionDrive& drive, double width,
                                             std::span<const double> times, double position,
                                             double speed,
                                             const StickSlipSettings& settings = {});

}  // namespace flexspline
