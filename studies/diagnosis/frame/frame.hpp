#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "flexspline/core/error.hpp"
#include "flexspline/core/recording.hpp"

namespace flexspline::studies {

/// The equations of a drive, Dhaouadi and Ghorbel (2003): motor (5), load (6), torsion (7).
enum class Equation { torsion, load, motor };

std::string_view name_of(Equation equation);

/// A motion that comes again: its last rows are where those a period before were.
struct Repeat {
  Eigen::Index period = 0;  ///< rows; 0: it does not
  Eigen::Index rows = 0;
};

/// Rows [first, first + count) of a frame that come from one recording.
struct Segment {
  std::string id;
  Eigen::Index first = 0;
  Eigen::Index count = 0;
  Split split = Split::unassigned;
  Repeat repeat = {};
  std::size_t bandwidth = 0;  ///< of its accelerations: which of Frame::accelerations
  double zero = 0.0;  ///< torsion as recorded from which its own is counted, beside Frame::zero
};

/// A stretch of one recording that has something of its own, and is left out.
struct Incident {
  Equation equation = Equation::torsion;  ///< whose residual shows it
  std::size_t segment = 0;
  Eigen::Index first = 0;  ///< row of the frame
  Eigen::Index count = 0;
  double size = 0.0;  ///< rms of what the laws leave there, over the largest torque
};

class KeptBaselines;

struct Accelerations;

/// All recordings of a set on one list of rows, motions smoothed. SI; motor quantities at the motor
/// shaft, others at the output. A channel that the rig does not have is zero; on a specimen the
/// imposed motion is motor, load and torsion at once, with ratio 1 unless stated.
struct Frame {
  Rig rig = Rig::locked;
  double ratio = 1.0;
  double motor_inertia = 0.0;
  double load_inertia = 0.0;
  double load_mass = 0.0;  ///< of a servo's pendulum and its arm, as the set states them; else 0
  double arm_length = 0.0;
  /// What of a servo's motor is recorded; duty_cycle: with the supply, a voltage.
  Quantity drives = Quantity::motor_torque;
  bool travels = false;      ///< an angle that travels: f is a free function of it
  bool own_zeros = false;    ///< every recording has a zero of its own
  double zero = 0.0;         ///< torsion as recorded from which that of all of them is counted
  bool firm_spring = false;  ///< f is nowhere much softer than in the mean
  double torque_lag = 0.0;   ///< time constant of the filter behind which the torque is recorded, s
  /// No sensor measures the torque across a free drive's gear: it is J2 theta_l'', without what
  /// else resists at the load, which the torsion's and the motor's equation have instead.
  bool torque_by_inertia = false;
  std::vector<Equation> equations;
  std::vector<std::string> notes;  ///< what could not be judged, and why
  std::vector<Segment> segments;
  std::vector<Incident> incidents;

  Eigen::ArrayXd time;   ///< of the recording
  Eigen::ArrayXd clock;  ///< shared by the set, from 0
  Eigen::ArrayXd motor_angle, motor_speed, motor_acceleration;
  Eigen::ArrayXd motor_bandwidth;  ///< of its acceleration, rad/s; empty: nothing is smoothed
  Eigen::ArrayXd load_angle, load_speed, load_acceleration;
  Eigen::ArrayXd torsion, torsion_rate, torsion_acceleration;
  /// Standard deviations by row; empty: not known. On a locked rig the two are one.
  Eigen::ArrayXd motor_speed_error, torsion_error, torsion_rate_error;
  Eigen::ArrayXd motor_acceleration_error, load_acceleration_error;
  /// Those above behind the bandwidth of their motion, then behind narrower ones; null: only those.
  std::shared_ptr<const std::vector<Accelerations>> accelerations;
  /// What of the torsion's rate comes and goes with the motor's turn: an error of the angles or of
  /// the gear, which laws do not depend on; empty: nothing.
  Eigen::ArrayXd periodic_rate;
  Eigen::ArrayXd torque;                      ///< measured, across the transmission
  Eigen::ArrayXd smooth_torque, torque_rate;  ///< the same, smoothed
  Eigen::ArrayXd told_torque;                 ///< as the torsion tells it: told_torque(); of drives
  Eigen::ArrayXd velocity;                    ///< recorded, of the output; NaN where none was
  Eigen::ArrayXd gravity;                     ///< of a servo's pendulum, m g l sin(theta_l)
  Eigen::ArrayXd motor_torque;                ///< recorded, at the motor shaft
  Eigen::ArrayXd smooth_motor_torque, motor_torque_rate;
  Eigen::ArrayXd usable;  ///< 1, or 0 where the bench spoiled the sample or smoothing has no hold
  Eigen::ArrayXd accelerations_held;  ///< Accelerations::held; empty: 1 everywhere
  Eigen::ArrayXd motor_slides;        ///< motor_slides() where counted(); empty: 1 everywhere

  double torsion_range = 0.0;  ///< largest |torsion|
  double lowest = 0.0;         ///< torsion, of all rows
  double highest = 0.0;        ///< the same
  double rate_range = 0.0;     ///< largest |torsion rate|
  double slow_rate = 0.0;      ///< second percentile of |torsion rate|
  double speed_range = 0.0;    ///< largest |motor speed|
  double torque_range = 0.0;   ///< largest |torque|
  double duration = 0.0;       ///< longest recording
  double interval = 0.0;       ///< median time between rows
  double session = 0.0;        ///< of the clock

  /// Columns that were built, for this frame and its copies; none: they are built each time.
  std::shared_ptr<KeptBaselines> kept;

  Eigen::Index rows() const { return time.size(); }
  /// Of a servo's pendulum: m, l and m g l, those that are not stated as 1 kg and 1 m.
  double pendulum_mass() const { return load_mass > 0.0 ? load_mass : 1.0; }
  double pendulum_arm() const { return arm_length > 0.0 ? arm_length : 1.0; }
  double pendulum_moment() const;
  /// The torque of that pendulum where its load turns: gravity, and with it all of the torque.
  void hang_pendulum();
  /// The torque that the load's inertia takes, where torque_by_inertia.
  void weigh_load();
  bool has(Equation equation) const;
  /// 1 for the rows that an equation is fitted to and judged on: those that are usable, of an
  /// equation with accelerations where these are held, of the motor's where it slides.
  Eigen::ArrayXd rows_of(Equation equation) const;
  /// A signal on those rows, NaN on the others.
  Eigen::ArrayXd judged_part(Equation equation, const Eigen::ArrayXd& signal) const;
  /// Largest |torque| that an equation explains, over usable rows: at the motor shaft or across the
  /// transmission.
  double largest_torque(Equation equation) const;
  /// A signal behind a filter of first order: T y' + y = x, exact for x linear between rows,
  /// settled at the start of every recording.
  Eigen::ArrayXd filtered(const Eigen::ArrayXd& signal, double time_constant) const;
  /// A torque signal as it is recorded, behind torque_lag.
  Eigen::ArrayXd recorded(const Eigen::ArrayXd& signal) const {
    return filtered(signal, torque_lag);
  }
  /// Largest angular frequency of the motion: its largest acceleration over its largest speed, 1/s.
  double fastest() const;
  /// Longest time constant of a filter that is looked for, s: beyond it nothing of a reversal
  /// shows.
  double longest_lag() const { return 4.0 / fastest(); }
  /// Ranges of torsion and rate anew, after a change of either.
  void measure_torsion();
};

/// The frame of a set. More rows than most_rows are thinned evenly, recording by recording;
/// recordings are put in order of their time and content, so that the order in the file does not
/// matter.
/// Errors: bad_data where the rig's channels do not give one equation.
Result<Frame> make_frame(const RecordingSet& set, Eigen::Index most_rows);

}  // namespace flexspline::studies
