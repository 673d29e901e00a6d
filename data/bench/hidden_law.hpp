#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "flexspline/data/hidden_bench.hpp"

namespace flexspline::data {

/// The ideal signals of one recording on the fine grid. A specimen's motor_angle is its torsion; a
/// locked output has load angle 0.
struct HiddenSignals {
  double start_s = 0.0;
  double step = 0.0;
  std::vector<double> motor_angle;
  std::vector<double> load_angle;
  std::vector<double> torque;
  std::vector<double> motor_torque;

  std::size_t size() const { return torque.size(); }
  double clock(std::size_t k) const { return start_s + step * static_cast<double>(k); }
};

/// A trial of the torsion at the end of a step that began where the law last remembered.
struct TorsionPoint {
  double torsion = 0.0;
  double step = 0.0;         ///< s; 0 at the start
  double motor_angle = 0.0;  ///< of a gear without kinematic error
  double rate = 0.0;         ///< of the torsion; 0 when remembered
  double clock = 0.0;
};

struct LoadPoint {
  double angle = 0.0;  ///< of the load; the torsion where the output is locked
  double velocity = 0.0;
  double acceleration = 0.0;
  double clock = 0.0;
};

struct MotorPoint {
  double angle = 0.0;
  double velocity = 0.0;
  double torque = 0.0;  ///< transmitted, at the output
  double drive = 0.0;   ///< motor torque without the effects
  double clock = 0.0;
};

/// What one effect adds in one recording; an empty function adds nothing. Functions may own a
/// memory: motor is called once a step in order, transmission any number of times before remember.
struct HiddenLaw {
  std::vector<HiddenParameter> parameters;
  std::function<double(const TorsionPoint&)> transmission;  ///< Nm beside f and g^-1
  std::function<void(const TorsionPoint&)> remember;
  std::function<double(double)> windup;            ///< rad in series, of the law's torque; rising
  std::function<double(double)> kinematic;         ///< rad at the output, of the motor angle
  std::function<double(const LoadPoint&)> load;    ///< Nm the sensor sees beyond the equation
  std::function<double(const MotorPoint&)> motor;  ///< Nm at the motor that resist
  std::function<void(HiddenSignals&)> sensing;
  std::optional<HiddenPlace> place{};  ///< where alone it acts
};

/// How large things are on the bench without effects, and the numbers an effect draws by.
struct HiddenScale {
  Rig rig = Rig::locked;
  bool travels = false;
  const HiddenGear* gear = nullptr;
  std::uint64_t seed = 0;
  double torque = 0.0;  ///< peaks: Nm
  double motor_torque = 0.0;
  double torque_rate = 0.0;  ///< Nm/s
  double motor_torque_rate = 0.0;
  double motion = 0.0;  ///< rad, of the held shaft
  double speed = 0.0;
  double acceleration = 0.0;
  double motor_speed = 0.0;
  double torsion = 0.0;
  double mean_rate = 0.0;  ///< rad/s, geometric mean of the excitations
  double clock_end = 0.0;  ///< s
  struct Span {
    std::string id;
    double start_s = 0.0;
    double duration = 0.0;
  };
  std::vector<Span> recordings;  ///< by id

  /// In [low, high): a pure function of (seed, id, index).
  double draw(std::string_view id, std::uint64_t index, double low, double high) const;

  /// The torque that the rig's fits explain: a servo has the motor's alone.
  std::vector<double> HiddenSignals::*effort() const {
    return rig == Rig::servo ? &HiddenSignals::motor_torque : &HiddenSignals::torque;
  }
  double effort_peak() const { return rig == Rig::servo ? motor_torque : torque; }

  /// Where friction acts: at the motor; on a specimen, which has none, in what the sensor sees.
  bool at_motor() const { return rig != Rig::specimen; }
  double friction_speed() const { return at_motor() ? motor_speed : speed; }
  double friction_torque() const { return at_motor() ? motor_torque : torque; }
};

/// Friction as a function of (speed, clock), put where friction acts on the rig.
inline void put_friction(HiddenLaw& law, const HiddenScale& scale,
                         std::function<double(double, double)> friction) {
  if (scale.at_motor()) {
    law.motor = [friction](const MotorPoint& x) { return friction(x.velocity, x.clock); };
  } else {
    law.load = [friction](const LoadPoint& x) { return friction(x.velocity, x.clock); };
  }
}

/// x / sqrt(x^2 + width^2).
inline double soft_sign(double x, double width) { return x / std::sqrt(x * x + width * width); }

}  // namespace flexspline::data
