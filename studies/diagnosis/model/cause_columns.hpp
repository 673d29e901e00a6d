#pragma once

#include "diagnosis/frame/rate_of.hpp"
#include "diagnosis/model/cause.hpp"

namespace flexspline::studies {

inline const std::vector<Rig> kDrives = {Rig::locked, Rig::free};
inline const std::vector<Rig> kMotors = {Rig::locked, Rig::free, Rig::servo};
inline const std::vector<Rig> kTurning = {Rig::free, Rig::servo};
inline const std::vector<Rig> kAnyRig = {Rig::locked, Rig::free, Rig::specimen};

/// On a specimen: an angle that travels. Other rigs' angles do.
bool travels(const Frame& frame);

/// On a specimen: one that is wound up and does not travel. Other rigs' transmissions are.
bool wound_up(const Frame& frame);

/// The motor turns by a gear ratio that is known.
bool geared(const Frame& frame);

/// sin(k x) and cos(k x), each times a factor.
Columns sine_pair(const Eigen::ArrayXd& x, double order, const Eigen::ArrayXd& factor);
Columns sine_pair(const Eigen::ArrayXd& x, double order);

/// What a term of the torque sensor adds to the equations that use its signal: tau in the torsion
/// and the load equation, -tau/N in the motor's.
Columns of_torque_signal(Equation equation, const Frame& frame, Columns terms);

/// Of the torque across the gear what is smooth, less the offset of its readings.
Eigen::ArrayXd smooth_torque(const Frame& frame, const Reference& known);

/// Stop operators (elastic-plastic elements of unit stiffness) along every recording, unloaded at
/// its start.
Columns stop_operators(const Frame& frame, const Eigen::ArrayXd& motion,
                       const std::vector<double>& yields);

/// count values from first to last, even in the logarithm.
std::vector<double> geometric(double first, double last, int count);

/// The terms of elements along a grid: name_1 at the first value, and so on.
std::vector<Term> elements(const std::vector<double>& grid, const Term& each);

/// A smooth signal a delay later, in every recording: cubic between rows, by the slopes of their
/// neighbours; held beyond the ends.
Eigen::ArrayXd later(const Frame& frame, const Eigen::ArrayXd& signal, double delay);

/// Fraction of what warms up that is left, exp(-clock/T).
Eigen::ArrayXd cold_share(const Frame& frame, double time_constant);

/// What to add to the torsion, a_k sin(k x) + b_k cos(k x) by order, so that it follows the torque:
/// by regression of the torsion on torque, its rate and cube, the load's speed and the turns.
std::vector<double> periodic_torsion(const Frame& frame, const Eigen::ArrayXd& angle,
                                     const std::vector<double>& orders);

}  // namespace flexspline::studies
