#include <algorithm>
#include <array>

#include "diagnosis/model/cause_columns.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Values = std::span<const double>;

constexpr std::array kOrders = {2.0, 4.0, 1.0};
constexpr std::array<std::size_t, 3> kByOrder = {2, 0, 1};

std::vector<Shape> amplitudes(const Frame& f) {
  const double most = 0.5 * f.torsion_range;
  std::vector<Shape> shapes;
  for (std::string_view name : {"sine_2", "cosine_2", "sine_4", "cosine_4", "sine_1", "cosine_1"}) {
    shapes.push_back({.name = name,
                      .unit = "rad",
                      .lower = -most,
                      .upper = most,
                      .logarithmic = false,
                      .meaning = "amplitude by the turns of the motor"});
  }
  return shapes;
}

// phi += e(theta_m), e = sum_k a_k sin(k theta_m) + b_k cos(k theta_m), and its rate; its work is
// the motor's, which feels tau de/dtheta_m beside tau/N. Each order is twice another, so that its
// sine and cosine follow.
void error(Frame& f, Values shape) {
  ArrayXd s = f.motor_angle.sin();
  ArrayXd c = f.motor_angle.cos();
  ArrayXd slope = ArrayXd::Zero(f.rows());
  double order = 1.0;
  for (const std::size_t i : kByOrder) {
    for (; order < kOrders[i]; order *= 2.0) {
      s *= 2.0 * c;
      c = 2.0 * c.square() - 1.0;
    }
    f.torsion += shape[2 * i] * s + shape[2 * i + 1] * c;
    slope += order * (shape[2 * i] * c - shape[2 * i + 1] * s);
  }
  f.torsion_rate += f.motor_speed * slope;
  f.motor_torque -= f.smooth_torque * slope;
}

std::vector<double> start(const Frame& f) {
  return periodic_torsion(f, f.motor_angle, {kOrders.begin(), kOrders.end()});
}

std::vector<Shape> turns(const Frame&) {
  return {{.name = "order",
           .unit = "1",
           .lower = 1.0,
           .upper = 4.0,
           .discrete = true,
           .meaning = "of a turn of the motor"}};
}

// A joint whose torsion is not measured shows the torque that the error winds up.
Columns torque_wound_up(Equation, const Frame& f, const Reference&, Values shape) {
  return sine_pair(f.motor_angle, shape[0]);
}

bool ripples(double order) { return std::ranges::find(kOrders, order) != kOrders.end(); }

Counterpart as_error(const FittedCause& c) {
  EffectSpec effect{"kinematic_error", {}};
  for (std::size_t i = 0; i < kOrders.size(); ++i) {
    const auto one = harmonic(kOrders[i], c.shape[2 * i], c.shape[2 * i + 1]);
    effect.parameters.insert(effect.parameters.end(), one.begin(), one.end());
  }
  return {.effects = {std::move(effect)}};
}

constexpr std::string_view kNoTorsion =
    "a model file has kinematic errors in the torsion, which was not measured";

std::vector<Term> terms(const Frame&) {
  return {{"sine", "Nm", "of the torque that the error winds up"}, {"cosine", "Nm", "its cosine"}};
}

}  // namespace

CauseRow describe_kinematic_error() {
  return {.id = "kinematic_error",
          .coordinate = "motor_angle",
          .forms = {{.equation = "phi = theta_m/N - theta_l + sum_k e_k sin(k theta_m + p_k)",
                     .rigs = {Rig::free},
                     .at = {Equation::torsion, Equation::motor},
                     .shapes = amplitudes,
                     .transform = error,
                     .start = start,
                     .counterpart = as_error},
                    {.equation = "tau += a sin k N q + b cos k N q",
                     .rigs = {Rig::specimen},
                     .at = {Equation::torsion},
                     .shapes = turns,
                     .terms = terms,
                     .columns = torque_wound_up,
                     .where = travels,
                     .ripples = ripples,
                     .no_counterpart = kNoTorsion}}};
}

}  // namespace flexspline::studies
