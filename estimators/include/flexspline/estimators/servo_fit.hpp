#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "flexspline/core/drive_spec.hpp"
#include "flexspline/estimators/method.hpp"

namespace flexspline::estimators {

/// drive: at the estimate; its weight is its last effect, gravity_load, whose phase is the zero of
/// the angle, and its load_mass 0. The estimate's model holds the effects that were given.
struct ServoFit {
  Estimate estimate;
  DriveSpec drive;
};

/// Where the duty cycle comes from in a simulation: as recorded, or from the servo's own loop,
/// duty = kp (commanded - simulated angle) within -1 and 1, which corrects what the model misses.
/// kp of each recording comes from its duty cycle, commanded and measured angle.
enum class ServoDuty { recorded, loop };

/// What an error of the angle costs: its square, or nearly its magnitude (soft_l1 of a tenth of the
/// misfit's size), for models whose errors are far from normal.
enum class ServoLoss { squared, absolute };

/// The arm between axis and load: without mass, or a uniform rod of unknown mass m_a, which adds
/// m_a g l sin(theta)/2 and m_a l^2/3. Nothing on a servo measures a torque, so that all torques
/// scale with the weight known: the rod is told apart by what its inertia does to friction that
/// grows with the load, or not at all.
enum class ServoArm { massless, rod };

/// The angle shown where the load hangs at rest: zero as recorded, or unknown within half a radian.
enum class ServoZero { recorded, fitted };

struct ServoSettings {
  int most_iterations = 100;
  std::size_t every = 4;  ///< every how manieth sample has a residual
  double tolerance = 1e-6;
  ServoDuty duty = ServoDuty::recorded;
  ServoLoss loss = ServoLoss::squared;
  ServoArm arm = ServoArm::massless;
  ServoZero zero = ServoZero::recorded;
  int starts = 1;    ///< fits from as many starts, drawn within a factor of 2 about the usual one;
                     ///< the best counts as converged where two end there
  int searches = 0;  ///< without derivatives (search_ode, 1500 simulations each, at ten times the
                     ///< tolerance), from whose best the fit starts, instead of several starts; it
                     ///< counts as converged where two searches end there
  std::uint64_t seed = 1;                 ///< of those starts or searches
  std::map<std::string, double> start{};  ///< of unknowns by name, instead of their usual ones
};

/// Output error of a servo: its angle is simulated from the first sample of every training
/// recording on, by the duty cycle (or what the loop commands) and the supply alone, and compared
/// with the one measured (single shooting, CVODES, Ceres). Unknown: torque constant (equal to that
/// of the back-EMF, SI), resistance, motor inertia, what the settings say of arm and zero, and the
/// parameters of the model's effects that are not held; its laws have no say, the transmission
/// being rigid. Known: load_mass_kg and arm_length_m of the set, as a point mass. Starts of the
/// drive's constants come from the equation error, those of effects from the model. Standard
/// deviations are widened by what neighbouring residuals have in common. Errors: input_missing,
/// where the set lacks a channel or constant; those of fit_ode.
Result<ServoFit> fit_servo(const RecordingSet& set, const GivenModel& model,
                           const ServoSettings& settings = {});

/// The angle of a servo at a recording's instants, from its first sample on, rad.
/// Errors: those of the integration.
Result<std::vector<double>> simulate_servo(const DriveSpec& drive, const Recording& recording,
                                           double tolerance = 1e-6,
                                           ServoDuty duty = ServoDuty::recorded);

}  // namespace flexspline::estimators
