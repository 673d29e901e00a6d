#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "flexspline/core/recording.hpp"
#include "flexspline/core/signals.hpp"

namespace flexspline::data {

/// What the checks look at in a recording: its channels, thinned to some thousand samples, and
/// smooth rates. SI; motor quantities at the motor shaft. Channels that are absent or constant are
/// empty, so that nothing is read out of them.
struct Observed {
  const Recording* recording = nullptr;
  Eigen::ArrayXd time;
  Eigen::ArrayXd motor_angle, motor_speed, motor_acceleration;
  Eigen::ArrayXd load_angle, load_speed, load_acceleration;
  Eigen::ArrayXd motion, rate;  ///< what the spring sees: torsion, displacement or angle
  Eigen::ArrayXd effort;        ///< transmitted torque, torque or force
  Eigen::ArrayXd drive;         ///< motor torque, current, or the voltage of a duty cycle
  Eigen::ArrayXd usable;        ///< 1, or 0 where the bench marked the sample or at an end
  std::optional<SineFit> sine;  ///< of what the bench moves; absent where it does not move
};

struct ObservedSet {
  const RecordingSet& set;
  std::vector<Observed> recordings;

  double constant(std::string_view key) const;  ///< NaN where the set does not state it
  bool travels() const;                         ///< an angle that travels: no spring
};

/// Channels of a rig that must move for anything to be learned.
std::vector<Quantity> telling_channels(const RecordingSet& set);

/// Those of them that a sensor measures: a duty cycle is what a controller says, and it may hold.
std::vector<Quantity> sensed_channels(const RecordingSet& set);

/// An angle or a displacement: what a bench may hold still.
bool is_position(Quantity quantity);

/// A recording without the samples that the bench marked with valid = 0.
Recording without_marked(const Recording& recording);

/// The channel that the rig's position loop moves: the motor's, the load's or the specimen's.
const std::vector<double>* held_motion(const RecordingSet& set, const Recording& recording);

double range_of(std::span<const double> values);
double range_of(const Eigen::ArrayXd& values);
double median_of(std::vector<double> values);

ObservedSet observe(const RecordingSet& set);

}  // namespace flexspline::data
