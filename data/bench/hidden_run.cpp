#include "bench/hidden_run.hpp"

#include <cmath>

#include "bench/hidden_differences.hpp"
#include "bench/hidden_motion.hpp"
#include "bench/hidden_torsion.hpp"

namespace flexspline::data {
namespace {

constexpr double kGravity = 9.81;

using Laws = std::vector<HiddenLaw>;

double seen_at_load(const Laws& laws, const Jet& motion, double clock) {
  double torque = 0.0;
  for (const HiddenLaw& law : laws) {
    if (law.load) torque += law.load({motion.value, motion.first, motion.second, clock});
  }
  return torque;
}

/// J2 th2'' + B2 th2' + m g l sin th2.
double load_torque(const HiddenGear& gear, const Jet& motion) {
  return gear.load_inertia * motion.second + gear.load_drag * motion.first +
         gear.load_mass * kGravity * gear.arm_length * std::sin(motion.value);
}

/// th1 = N (th2 + phi - e(th1)), by repetition: e turns by far less than 1/N a turn of th1.
double motor_angle(const HiddenGear& gear, const Laws& laws, double rigid) {
  double angle = gear.gear_ratio * rigid;
  for (int k = 0; k < 60; ++k) {
    double error = 0.0;
    for (const HiddenLaw& law : laws) {
      if (law.kinematic) error += law.kinematic(angle);
    }
    const double next = gear.gear_ratio * (rigid - error);
    if (next == angle) break;
    angle = next;
  }
  return angle;
}

void run_shafts(HiddenSignals& s, Rig rig, const HiddenGear& gear, const HeldMotion& held,
                Laws& laws) {
  const bool moves_load = rig == Rig::free || rig == Rig::servo;
  HiddenTorsion torsion(gear, laws, s.start_s, s.step);
  for (std::size_t k = 0; k < s.motor_angle.size(); ++k) {
    const Jet motion = held.at(s.step * static_cast<double>(k));
    const double seen = seen_at_load(laws, motion, s.clock(k));
    if (moves_load) {
      s.load_angle[k] = motion.value;
      s.torque[k] = load_torque(gear, motion) + seen;
      const double phi = torsion.carry(s.torque[k], motion.value).torsion;
      s.motor_angle[k] = motor_angle(gear, laws, motion.value + phi);
    } else {
      s.torque[k] = torsion.follow(motion.value, motion.first).torque + seen;
      s.motor_angle[k] = gear.gear_ratio * motion.value;
    }
  }
}

/// What the torque returns to the motor as the kinematics turn with it, by virtual work: de/dth1
/// per Nm.
double kinematic_slope(const Laws& laws, double angle) {
  constexpr double kStep = 1e-4;
  double change = 0.0;
  for (const HiddenLaw& law : laws) {
    if (law.kinematic) change += law.kinematic(angle + kStep) - law.kinematic(angle - kStep);
  }
  return change / (2.0 * kStep);
}

/// J1 th1'' + B1 th1' + friction + tau (1/N + de/dth1).
void run_motor(HiddenSignals& s, const HiddenGear& gear, const Laws& laws) {
  const std::vector<double> speed = slopes(s.motor_angle, s.step);
  const std::vector<double> bend = bends(s.motor_angle, s.step);
  for (std::size_t k = 0; k < s.size(); ++k) {
    const double drive =
        gear.motor_inertia * bend[k] + gear.motor_drag * speed[k] +
        gear.motor_coulomb * soft_sign(speed[k], gear.motor_coulomb_speed) +
        s.torque[k] * (1.0 / gear.gear_ratio + kinematic_slope(laws, s.motor_angle[k]));
    s.motor_torque[k] = drive;
    for (const HiddenLaw& law : laws) {
      if (!law.motor) continue;
      s.motor_torque[k] += law.motor({s.motor_angle[k], speed[k], s.torque[k], drive, s.clock(k)});
    }
  }
}

}  // namespace

HiddenSignals run_session(const HiddenBench& bench, const HiddenSession& session,
                          const HiddenScale& scale, const std::vector<HiddenAmount>& effects) {
  Laws laws;
  for (const HiddenAmount& effect : effects) laws.push_back(effect.row->make(scale, effect.amount));
  const auto steps = static_cast<std::size_t>(session.excitation.samples) * kStepsPerSample + 1;
  HiddenSignals s;
  s.start_s = session.start_s;
  s.step = session.interval() / kStepsPerSample;
  for (auto* channel : {&s.motor_angle, &s.load_angle, &s.torque, &s.motor_torque}) {
    channel->assign(steps, 0.0);
  }
  const HiddenGear gear = gear_of(bench, session);
  run_shafts(s, bench.rig, gear, HeldMotion(session.excitation, bench.seed, session.id), laws);
  if (bench.rig != Rig::specimen) run_motor(s, gear, laws);
  for (const HiddenLaw& law : laws) {
    if (law.sensing) law.sensing(s);
  }
  return s;
}

std::vector<HiddenSignals> run_sessions(const HiddenBench& bench,
                                        const std::vector<HiddenSession>& sessions,
                                        const HiddenScale& scale,
                                        const std::vector<HiddenAmount>& effects) {
  std::vector<HiddenSignals> runs;
  runs.reserve(sessions.size());
  for (const HiddenSession& session : sessions) {
    runs.push_back(run_session(bench, session, scale, effects));
  }
  return runs;
}

}  // namespace flexspline::data
