#include "flexspline/core/torque_signal.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "flexspline/core/effect_path.hpp"
#include "rigs/drive_at.hpp"

namespace flexspline {
namespace {

struct Point {
  double time;
  double position;
  double velocity;
  double acceleration;
};

Point point_of(const Motion& m, std::size_t i) {
  return {m.time[i], m.position[i], m.velocity[i], m.acceleration[i]};
}

// The quintic with position, velocity and acceleration of both ends.
class Quintic {
 public:
  Quintic(const Point& a, const Point& b) : a_(a), h_(b.time - a.time) {
    const double x = b.position - a.position - h_ * (a.velocity + 0.5 * h_ * a.acceleration);
    const double v = h_ * (b.velocity - a.velocity - h_ * a.acceleration);
    const double w = h_ * h_ * (b.acceleration - a.acceleration);
    c_[0] = 10.0 * x - 4.0 * v + 0.5 * w;
    c_[1] = -15.0 * x + 7.0 * v - w;
    c_[2] = 6.0 * x - 3.0 * v + 0.5 * w;
  }

  Point at(double t) const {
    const double s = t - a_.time;
    const double u = s / h_;
    const double cubic = u * u * u;
    const double position = cubic * (c_[0] + u * (c_[1] + u * c_[2]));
    const double slope = u * u * (3.0 * c_[0] + u * (4.0 * c_[1] + u * 5.0 * c_[2])) / h_;
    const double bend = u * (6.0 * c_[0] + u * (12.0 * c_[1] + u * 20.0 * c_[2])) / (h_ * h_);
    return {t, a_.position + s * (a_.velocity + 0.5 * s * a_.acceleration) + position,
            a_.velocity + s * a_.acceleration + slope, a_.acceleration + bend};
  }

 private:
  Point a_;
  double h_;
  double c_[3] = {};
};

// Where the motion turns between two samples whose velocities differ in sign.
double turning_time(const Quintic& motion, double low, double high) {
  const bool rising = motion.at(low).velocity < 0.0;
  for (int k = 0; k < 100; ++k) {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high) break;
    ((motion.at(middle).velocity < 0.0) == rising ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

class TorqueAlong {
 public:
  TorqueAlong(DriveModel model, const Motion& motion) : model_(std::move(model)) {
    for (const auto& one : flexspline::parameters_of(model_.drive(), model_.constants())) {
      p_.push_back(one.value);
    }
    std::vector<double> memory(model_.memory(), 0.0);
    append(point_of(motion, 0), memory);
    for (std::size_t i = 1; i < motion.time.size(); ++i) {
      const Point before = point_of(motion, i - 1);
      const Point after = point_of(motion, i);
      const Quintic piece(before, after);
      if (before.velocity * after.velocity < 0.0) {
        append(piece.at(turning_time(piece, before.time, after.time)), memory);
      }
      append(after, memory);
      if (lost_ != nullptr) return;
    }
  }

  /// The first effect whose memory no steps could follow, and how far it had come.
  const EffectRow* lost() const { return lost_; }
  double reached() const { return knots_.back().point.time; }

  double operator()(double t) const {
    const auto after = std::ranges::upper_bound(knots_, t, {}, &Knot::time);
    if (after == knots_.begin()) return torque(knots_.front().point, knots_.front().memory);
    if (after == knots_.end()) return torque(knots_.back().point, knots_.back().memory);
    const Knot& before = *(after - 1);
    const Point now = Quintic(before.point, after->point).at(t);
    std::vector<double> memory = before.memory;
    advance(before.point, now, memory);
    return torque(now, memory);
  }

 private:
  struct Knot {
    Point point;
    std::vector<double> memory;
    double time() const { return point.time; }
  };

  static Instant<double> instant(const Point& p) {
    Instant<double> x;
    x.time = p.time;
    x.motor_angle = x.load_angle = x.torsion = p.position;
    x.motor_speed = x.load_speed = x.torsion_rate = p.velocity;
    x.motor_acceleration = x.load_acceleration = x.torsion_acceleration = p.acceleration;
    return x;
  }

  // With the kinematics and the torque of the law, which the forces see.
  Instant<double> seen(const DriveAt<double>& at, const Point& point) const {
    Instant<double> x = instant(point);
    at.add_kinematics(x);
    x.transmitted_torque = at.torsion_law(x);
    return x;
  }

  void append(const Point& point, std::vector<double>& memory) {
    if (!knots_.empty()) lost_ = advance(knots_.back().point, point, memory);
    if (lost_ == nullptr) knots_.push_back({point, memory});
  }

  // Gives the first effect whose memory no steps could follow.
  const EffectRow* advance(const Point& from, const Point& to, std::vector<double>& memory) const {
    const DriveAt<double> at(model_, p_, memory);
    const auto before = seen(at, from);
    const auto after = seen(at, to);
    for (const EffectUse& use : model_.effects()) {
      if (use.states == 0) continue;
      const auto states = std::span(memory).subspan(use.state, use.states);
      if (use.row->rate_independent) {
        use.row->real.advance(before, after, parameters_of(use), states);
      } else if (!integrate(use, at, from, to, states)) {
        return use.row;
      }
    }
    return nullptr;
  }

  std::span<const double> parameters_of(const EffectUse& use) const {
    return std::span(p_).subspan(use.parameter, use.parameters);
  }

  // A memory that knows the clock follows the curve between the instants, not only its ends: by
  // steps of Runge and Kutta's, twice as many until they agree. False where they never do.
  bool integrate(const EffectUse& use, const DriveAt<double>& at, const Point& from,
                 const Point& to, std::span<double> states) const {
    constexpr int kMostSteps = 1 << 12;
    if (!(to.time > from.time)) return true;
    const Quintic motion(from, to);
    std::vector<double> last = runge_kutta(use, at, motion, from.time, to.time, states, 2);
    for (int steps = 4; steps <= kMostSteps; steps *= 2) {
      const auto next = runge_kutta(use, at, motion, from.time, to.time, states, steps);
      bool agree = true;
      for (std::size_t j = 0; j < next.size(); ++j) {
        const double size = std::abs(states[j]) + std::abs(next[j]);
        agree &= std::abs(next[j] - last[j]) <= 1e-11 * size;
      }
      last = next;
      if (!agree) continue;
      std::ranges::copy(last, states.begin());
      return true;
    }
    return false;
  }

  std::vector<double> runge_kutta(const EffectUse& use, const DriveAt<double>& at,
                                  const Quintic& motion, double from, double to,
                                  std::span<const double> start, int steps) const {
    const double h = (to - from) / steps;
    std::vector<double> states(start.begin(), start.end());
    std::vector<double> k(states.size()), sum(states.size()), trial(states.size());
    for (int n = 0; n < steps; ++n) {
      std::ranges::fill(k, 0.0);
      std::ranges::fill(sum, 0.0);
      for (const auto& [ahead, weight] :
           {std::pair(0.0, 1.0), {0.5, 2.0}, {0.5, 2.0}, {1.0, 1.0}}) {
        for (std::size_t j = 0; j < trial.size(); ++j) trial[j] = states[j] + ahead * h * k[j];
        const auto x = seen(at, motion.at(from + (n + ahead) * h));
        use.row->real.rate(x, parameters_of(use), trial, k);
        for (std::size_t j = 0; j < sum.size(); ++j) sum[j] += weight * k[j];
      }
      for (std::size_t j = 0; j < sum.size(); ++j) states[j] += h / 6.0 * sum[j];
    }
    return states;
  }

  double torque(const Point& point, const std::vector<double>& memory) const {
    const DriveAt<double> at(model_, p_, memory);
    Instant<double> x = seen(at, point);
    const double forces =
        at.sum(Site::transmission, x) + at.sum(Site::motor, x) + at.sum(Site::load, x);
    x.transmitted_torque += forces;
    return x.transmitted_torque + at.sum(Site::torque_signal, x);
  }

  DriveModel model_;
  std::vector<double> p_;
  std::vector<Knot> knots_;
  const EffectRow* lost_ = nullptr;
};

}  // namespace

Result<Signal> torque_signal(const ModelSpec& model, const Motion& motion) {
  expects(motion.time.size() >= 2, "a motion between two instants or more");
  DriveSpec drive;
  drive.torsion = model;
  auto made = DriveModel::make(drive, {}, {Site::torque_signal});
  if (!made) return tl::unexpected(made.error());
  if (made->kinematics_follow_torque()) {
    return failure(ErrorCode::bad_data,
                   "torque as a function of time: kinematics follow the torque, which is found "
                   "from sample to sample",
                   "simulate the specimen in its form displacement_driven, or use simulate_torque");
  }
  const auto along = std::make_shared<TorqueAlong>(std::move(*made), motion);
  if (along->lost() != nullptr) {
    return failure(ErrorCode::numerics,
                   fmt::format("torque as a function of time: the memory of {} switches while it "
                               "slips, and no steps follow it beyond {:.6g} s",
                               along->lost()->id, along->reached()),
                   "simulate the specimen in its form displacement_driven, or use simulate_torque");
  }
  return Signal{[along](double t) { return (*along)(t); }, {}};
}

Result<std::vector<double>> simulate_torsion(const ModelSpec& model, std::span<const double> time,
                                             const Signal& torque, double initial,
                                             const IntegratorSettings& settings) {
  DriveSpec drive;
  drive.torsion = model;
  const auto rig = make_rig(Rig::specimen, drive, {{{Quantity::transmitted_torque, torque}}, {}});
  if (!rig) return tl::unexpected(rig.error());
  std::vector<double> start = (*rig)->rest();
  start.front() = initial;
  SystemSettings how;
  how.relative_tolerance = settings.relative_tolerance;
  how.absolute_tolerance.assign(start.size(), settings.absolute_tolerance * model.f.scale);
  how.max_steps = settings.max_steps;
  const auto run = integrate_system(**rig, (*rig)->parameter_vector(), time, start, how);
  if (!run) return tl::unexpected(run.error());
  std::vector<double> torsion;
  for (std::size_t i = 0; i < run->state.size(); i += run->states) {
    torsion.push_back(run->state[i]);
  }
  return torsion;
}

}  // namespace flexspline
