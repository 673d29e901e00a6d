// A motor that holds still takes any torque up to its breakaway: nothing of it is missing physics.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "diagnosis_checks.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;

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
  const ArrayXd judged = frame->rows_of(Equation::motor);
  const ArrayXd slow = (frame->motor_speed.abs() <= 0.02 * frame->speed_range).cast<double>();
  EXPECT_EQ((judged * slow).maxCoeff(), 0.0);
  // What else is left out is no longer than the smoothed speed takes to turn, once in a move.
  const ArrayXd else_left_out = frame->usable * (1.0 - judged) * (1.0 - slow);
  EXPECT_LT(else_left_out.sum(), 2.0 * 2.0 * 5 * kMoves / frame->motor_bandwidth[0] / kInterval);
  EXPECT_TRUE((frame->rows_of(Equation::torsion) == frame->usable).all());
  // It holds still for 0.3 s of 0.6 to 0.9 s: at least a third.
  EXPECT_LT(judged.sum(), 0.67 * frame->usable.sum());
}

// The smoothed speed of a noisy sine passes a fiftieth of its largest sooner than it tells its
// sign.
TEST(Sticking, AReversalIsAsLongAsTheSmoothedSpeedTakes) {
  constexpr double kRate = 6.0;
  RecordingSet set;
  set.rig = Rig::locked;
  set.constants = {{"gear_ratio", kRatio}, {"motor_inertia_kgm2", kInertia}};
  Recording r;
  r.id = "sine";
  std::mt19937_64 engine(5);
  std::normal_distribution<double> noise;
  for (double t = 0.0; t < 10.0; t += kInterval) {
    r.time.push_back(t);
    r.channels[Quantity::motor_angle].push_back(0.3 * std::sin(kRate * t) + 3e-3 * noise(engine));
    r.channels[Quantity::transmitted_torque].push_back(60.0 * std::sin(kRate * t));
    r.channels[Quantity::motor_torque].push_back(std::sin(kRate * t + 0.2));
  }
  set.recordings = {r};
  const auto frame = make_frame(set, 20000);
  ASSERT_TRUE(frame.has_value());
  const double half = 1.0 / frame->motor_bandwidth[0];
  ASSERT_GT(half, 2.0 * 0.02 / kRate) << "longer than the slow rows";
  const ArrayXd judged = frame->rows_of(Equation::motor);
  constexpr double kPhase = std::numbers::pi / kRate;
  // Noise of the smoothed speed moves its zero by less than a fifth of that.
  for (Eigen::Index i = 0; i < judged.size(); ++i) {
    if (frame->usable[i] == 0.0) continue;
    const double from = std::abs(std::remainder(frame->time[i] - 0.5 * kPhase, kPhase));
    if (from < 0.8 * half) EXPECT_EQ(judged[i], 0.0) << frame->time[i];
    if (from > 1.2 * half) EXPECT_EQ(judged[i], 1.0) << frame->time[i];
  }
}

}  // namespace
}  // namespace flexspline::studies
