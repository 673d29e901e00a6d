// A motor that holds still takes any torque up to its breakaway: nothing of it is missing physics.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "diagnosis_checks.hpp"

namespace flexspline::studies {
namespace {

constexpr double kRatio = 100.0;
constexpr double kInertia = 1e-4;   // kg m2
constexpr double kBreakaway = 0.1;  // Nm at the motor, of 0.9 Nm that the gear takes at most
constexpr double kMove = 0.4;       // s, from one level to the next
constexpr double kHold = 0.3;       // s
constexpr double kInterval = 2e-3;

/// Of a motor that goes from level to level, each move a polynomial of fifth degree.
struct Motion {
  double angle = 0.0, speed = 0.0, acceleration = 0.0;
  double held = -1.0;  ///< since the move ended, s; negative while it moves
  std::size_t level = 0;
};

constexpr double kLevels[] = {0.0, 0.5, 1.0, 0.4, -0.2, -0.7, -1.0, -0.3, 0.0};
constexpr std::size_t kMoves = std::size(kLevels) - 1;

Motion motion_at(double t, double amplitude, double pace) {
  const double each = kMove / pace + kHold;
  Motion m;
  const auto k = static_cast<std::size_t>(t / each);
  m.level = k;
  const double from = kLevels[k % kMoves], way = kLevels[k % kMoves + 1] - from;
  const double x = std::min(1.0, (t - each * static_cast<double>(k)) * pace / kMove);
  const double rate = pace / kMove;
  const double size = kRatio * amplitude;
  m.angle = size * (from + way * x * x * x * (10.0 + x * (6.0 * x - 15.0)));
  m.speed = size * way * rate * 30.0 * x * x * (1.0 - x) * (1.0 - x);
  m.acceleration = size * way * rate * rate * 60.0 * x * (1.0 - x) * (1.0 - 2.0 * x);
  if (x == 1.0) m.held = t - each * static_cast<double>(k) - kMove / pace;
  return m;
}

/// What dry friction takes: of a motor that moves all of it, of one that holds what is left of the
/// last move or what its loop makes of it, `creep` of all.
double friction(const Motion& m, double creep) {
  if (m.held < 0.0) return m.speed == 0.0 ? 0.0 : std::copysign(kBreakaway, m.speed);
  const double way = kLevels[m.level % kMoves + 1] - kLevels[m.level % kMoves];
  const double forgotten = 1.0 - std::exp(-m.held / 0.05);
  return std::copysign(kBreakaway, way) * (1.0 - forgotten) + creep * kBreakaway * forgotten;
}

Recording recording(unsigned number, double amplitude, double pace) {
  std::mt19937_64 engine(number);
  std::normal_distribution<double> noise;
  std::uniform_real_distribution<double> anywhere(-1.0, 1.0);
  std::vector<double> creep(2 * kMoves + 1);
  for (double& one : creep) one = anywhere(engine);
  Recording r;
  r.id = "moves-" + std::to_string(number);
  r.start_s = 60.0 * number;
  const double each = kMove / pace + kHold;
  for (double t = 0.0; t < 2.0 * each * kMoves; t += kInterval) {
    const Motion m = motion_at(t, amplitude, pace);
    const double torsion = m.angle / kRatio, rate = m.speed / kRatio;
    const double torque =
        2e4 * torsion * (1.0 + 2e4 * torsion * torsion) + 2.0 * std::tanh(rate / 2e-3);
    r.time.push_back(t);
    r.channels[Quantity::motor_angle].push_back(m.angle + 1e-5 * noise(engine));
    r.channels[Quantity::transmitted_torque].push_back(torque + 0.3 * noise(engine));
    r.channels[Quantity::motor_torque].push_back(kInertia * m.acceleration + 2e-3 * m.speed +
                                                 friction(m, creep[m.level]) + torque / kRatio +
                                                 3e-3 * noise(engine));
  }
  return r;
}

TEST(Sticking, IsNotMissingPhysicsWhateverTheLoopHoldsAgainstIt) {
  RecordingSet set;
  set.name = "moves";
  set.rig = Rig::locked;
  set.constants = {{"gear_ratio", kRatio}, {"motor_inertia_kgm2", kInertia}};
  unsigned number = 0;
  for (const auto& [amplitude, pace] :
       {std::pair{4e-3, 1.0}, {3e-3, 1.3}, {4e-3, 0.7}, {2.5e-3, 1.0}, {3.5e-3, 0.8}}) {
    set.recordings.push_back(recording(++number, amplitude, pace));
  }
  const Diagnosis d = diagnosed(set);
  EXPECT_EQ(d.verdict, Verdict::adequate) << d.says;
  EXPECT_TRUE(d.causes.empty());

  // Of the motor's equation alone those rows are left out.
  const auto frame = make_frame(set, 20000);
  ASSERT_TRUE(frame.has_value());
  const auto slides = (frame->motor_speed.abs() > 0.02 * frame->speed_range).cast<double>();
  EXPECT_TRUE((frame->rows_of(Equation::motor) == frame->usable * slides).all());
  EXPECT_TRUE((frame->rows_of(Equation::torsion) == frame->usable).all());
  EXPECT_LT(frame->rows_of(Equation::motor).sum(), 0.7 * frame->usable.sum());
}

}  // namespace
}  // namespace flexspline::studies
