#include "decision/discrepancy.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/QR>

#include "decision/splines.hpp"
#include "diagnosis/cause_columns.hpp"
#include "diagnosis/middle.hpp"

namespace flexspline::studies::decision {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::MatrixXd;

constexpr int kSpline = 9;       // intervals over a coordinate
constexpr int kCoarse = 5;       // hats over one of two
constexpr int kMostWindows = 8;  // of a recording
constexpr double kStill = 0.02;  // of the largest speed
constexpr double kNoSign = 0.002;
constexpr double kCore = 0.003;  // of the largest speed
constexpr double kUnit = 0.01;   // of the largest torque

/// The motion that an equation is of.
struct Motion {
  const ArrayXd& position;
  const ArrayXd& speed;
  const ArrayXd& acceleration;
};

Motion motion_of(const Frame& f, Equation equation) {
  if (equation == Equation::torsion) return {f.torsion, f.torsion_rate, f.torsion_acceleration};
  if (equation == Equation::load) return {f.load_angle, f.load_speed, f.load_acceleration};
  return {f.motor_angle, f.motor_speed, f.motor_acceleration};
}

double largest(const ArrayXd& x, const ArrayXd& usable) {
  return std::max((x.abs() * usable).maxCoeff(), 1e-300);
}

// Signed way since the last reversal of every recording.
ArrayXd way_since_reversal(const Frame& f, const Motion& m) {
  ArrayXd way = ArrayXd::Zero(f.rows());
  for (const Segment& s : f.segments) {
    const double still = kStill * m.speed.segment(s.first, s.count).abs().maxCoeff();
    int heading = 0;
    double from = m.position[s.first];
    double furthest = from;
    for (Index r = s.first; r < s.first + s.count; ++r) {
      const int now = m.speed[r] > still ? 1 : m.speed[r] < -still ? -1 : 0;
      if (heading == 0) heading = now;
      if (now != 0 && now != heading) from = furthest, heading = now, furthest = m.position[r];
      if ((m.position[r] - furthest) * heading > 0.0) furthest = m.position[r];
      way[r] = heading == 0 ? 0.0 : m.position[r] - from;
    }
  }
  return way;
}

// The motion less what has relaxed of it, over four time constants.
MatrixXd lagging(const Frame& f, const ArrayXd& position) {
  const std::vector<double> constants = geometric(4.0 * f.interval, 0.25 * f.duration, 4);
  MatrixXd columns(f.rows(), 4);
  for (Index k = 0; k < 4; ++k) {
    columns.col(k) =
        (position - f.filtered(position, constants[static_cast<std::size_t>(k)])).matrix();
  }
  return columns;
}

MatrixXd sides(const Frame& f, const ArrayXd& sign) {
  MatrixXd columns = MatrixXd::Zero(f.rows(), 2 * static_cast<Index>(f.segments.size()));
  for (std::size_t i = 0; i < f.segments.size(); ++i) {
    const Segment& s = f.segments[i];
    const auto at = 2 * static_cast<Index>(i);
    columns.col(at).segment(s.first, s.count) =
        (sign.segment(s.first, s.count) > 0.0).cast<double>().matrix();
    columns.col(at + 1).segment(s.first, s.count).setOnes();
    columns.col(at + 1) -= columns.col(at);
  }
  return columns;
}

int cycles(const Segment& s, const ArrayXd& speed) {
  const auto part = speed.segment(s.first, s.count);
  const double still = kStill * part.abs().maxCoeff();
  int heading = 0;
  int turns = 0;
  for (const double v : part) {
    const int now = v > still ? 1 : v < -still ? -1 : 0;
    if (now != 0 && heading != 0 && now != heading) ++turns;
    if (now != 0) heading = now;
  }
  return (turns + 1) / 2;
}

// Hats over the time of each recording, none shorter than a cycle.
MatrixXd windows(const Frame& f, const ArrayXd& speed) {
  std::vector<MatrixXd> parts;
  Index total = 0;
  for (const Segment& s : f.segments) {
    const int count = std::min(kMostWindows, cycles(s, speed));
    const ArrayXd time = f.time.segment(s.first, s.count) - f.time[s.first];
    parts.push_back(count < 2 ? MatrixXd(s.count, 0)
                              : hats(time / std::max(time[s.count - 1], 1e-300), count + 1));
    total += parts.back().cols();
  }
  MatrixXd columns = MatrixXd::Zero(f.rows(), total);
  Index at = 0;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const Segment& s = f.segments[i];
    columns.block(s.first, at, s.count, parts[i].cols()) = parts[i];
    at += parts[i].cols();
  }
  return columns;
}

// Products of both, less what either orders alone.
MatrixXd jointly(const ArrayXd& x, const ArrayXd& v, const ArrayXd& usable) {
  MatrixXd alone(x.size(), 2 * (kSpline + 3) + 1);
  alone << spline(x, kSpline), spline(v, kSpline), MatrixXd::Ones(x.size(), 1);
  MatrixXd both = products(hats(0.5 * (x + 1.0), kCoarse), hats(0.5 * (v + 1.0), kCoarse));
  const auto weighted = usable.matrix().asDiagonal();
  MatrixXd normal = alone.transpose() * (weighted * alone);
  normal.diagonal().array() += 1e-8 * normal.diagonal().maxCoeff();
  const MatrixXd cross = alone.transpose() * (weighted * both);
  return both - alone * normal.ldlt().solve(cross);
}

MatrixXd turns(const ArrayXd& angle, const std::vector<double>& orders, const ArrayXd* sign) {
  MatrixXd columns(angle.size(), static_cast<Index>(orders.size()) * (sign != nullptr ? 4 : 2));
  Index at = 0;
  for (const double k : orders) {
    columns.col(at++) = (k * angle).sin().matrix();
    columns.col(at++) = (k * angle).cos().matrix();
    if (sign == nullptr) continue;
    columns.col(at++) = ((k * angle).sin() * *sign).matrix();
    columns.col(at++) = ((k * angle).cos() * *sign).matrix();
  }
  return columns;
}

}  // namespace

void add_block(Discrepancy& to, MatrixXd columns, std::string coordinate, std::string says,
               double unit, const ArrayXd& usable) {
  if (columns.cols() == 0) return;
  const double square = (usable.matrix().asDiagonal() * columns).squaredNorm() / usable.sum();
  if (!(square > 0.0)) return;
  const Index first = to.columns.cols();
  to.components.push_back({std::move(coordinate), std::move(says), first, columns.cols()});
  MatrixXd all(columns.rows(), first + columns.cols());
  if (first > 0) all.leftCols(first) = to.columns;
  all.rightCols(columns.cols()) = columns * (unit / std::sqrt(square));
  to.columns = std::move(all);
}

Discrepancy discrepancy_of(const Frame& f, Equation equation) {
  const Motion m = motion_of(f, equation);
  const ArrayXd& ok = f.usable;
  const double vm = largest(m.speed, ok);
  const double am = largest(m.acceleration, ok);
  const double pm = largest(m.position, ok);
  const ArrayXd x = m.position / pm;
  const ArrayXd v = compressed(m.speed, kCore * vm, vm);
  const ArrayXd a = compressed(m.acceleration, 0.05 * am, am);
  const ArrayXd sign = (m.speed / (kNoSign * vm)).tanh();
  const ArrayXd t = f.clock / std::max(f.session, 1e-300);
  const ArrayXd load = f.smooth_torque.abs() / largest(f.smooth_torque, ok);
  const ArrayXd way = way_since_reversal(f, m);
  const ArrayXd s = way.sign() * (way.abs() / std::max(2.0 * pm, 1e-300)).sqrt();
  const double unit = kUnit * f.largest_torque(equation);
  Discrepancy d;
  const auto add = [&](MatrixXd columns, const char* coordinate, const char* says) {
    centre(columns, ok);
    add_block(d, std::move(columns), coordinate, says, unit, ok);
  };
  const bool laws = equation == Equation::torsion;
  if (!laws) add(odd_spline(v, kSpline), "velocity", "the rate");
  add(even_spline(v, kSpline), "velocity", "the rate, alike both ways");
  if (!laws && f.rig != Rig::locked)
    add(spline(x, kSpline), equation == Equation::load ? "load_angle" : "motor_angle",
        "the position");
  if (!laws && f.rig == Rig::locked) add(spline(x, kSpline), "torsion", "the torsion");
  add(products(hats(load, kCoarse), sign.matrix()), "load", "the load, with the sign of motion");
  add(hats(t, kSpline - 1), "time", "the time of the session");
  add(products(hats(t, kCoarse), v.matrix()), "time", "the time of the session, with the rate");
  add(odd_spline(a, 7), "acceleration", "the acceleration");
  add(even_spline(a, 7), "acceleration", "the acceleration, alike both ways");
  add(odd_spline(s, kSpline), "reversal_memory", "the way since the last reversal");
  add(even_spline(s, kSpline), "reversal_memory",
      "the way since the last reversal, alike both ways");
  add(lagging(f, m.position / pm), "lag", "motion of the past");
  add(jointly(x, v, ok), "torsion", "position and rate together");
  if (f.rig == Rig::free || f.rig == Rig::servo || f.travels) {
    add(turns(f.motor_angle, {1.0, 2.0, 4.0}, &sign), "motor_angle", "turns of the motor");
  }
  if (f.rig == Rig::free || f.rig == Rig::servo) {
    add(turns(f.load_angle, {1.0, 2.0}, nullptr), "load_angle", "turns of the output");
  }
  add(sides(f, m.position), "constant", "side and recording");
  add(windows(f, m.speed), "window", "windows of the recordings");
  return d;
}

double rows_per_cycle(const Frame& f, Equation equation) {
  const Motion m = motion_of(f, equation);
  std::vector<double> rows;
  for (const Segment& s : f.segments) {
    rows.push_back(static_cast<double>(s.count) / std::max(1, cycles(s, m.speed)));
  }
  return middle(rows);
}

}  // namespace flexspline::studies::decision
