#include "diagnosis/frame/frame.hpp"

#include <algorithm>
#include <cmath>

#include "diagnosis/frame/low_pass.hpp"
#include "diagnosis/frame/middle.hpp"
#include "flexspline/core/estimate.hpp"

namespace flexspline::studies {

using Eigen::ArrayXd;
using Eigen::Index;

namespace {
constexpr double kGravity = 9.80665;  // m/s2
constexpr double kSlowest = 0.02;     // of the rows: of a triangle the reversals
}  // namespace

std::string_view name_of(Equation equation) {
  switch (equation) {
    case Equation::torsion:
      return "torsion";
    case Equation::load:
      return "load";
    case Equation::motor:
      break;
  }
  return "motor";
}

ArrayXd Frame::rows_of(Equation equation) const {
  ArrayXd rows = usable;
  const bool accelerates = equation != Equation::torsion || torque_by_inertia;
  if (accelerates && accelerations_held.size() > 0) rows *= accelerations_held;
  if (equation == Equation::motor && motor_slides.size() > 0) rows *= motor_slides;
  return rows;
}

ArrayXd Frame::judged_part(Equation equation, const ArrayXd& signal) const {
  return (rows_of(equation) > 0.0).select(signal, kNotComputed);
}

double Frame::largest_torque(Equation equation) const {
  return equation == Equation::motor ? (motor_torque.abs() * usable).maxCoeff() : torque_range;
}

ArrayXd Frame::filtered(const ArrayXd& signal, double time_constant) const {
  if (!(time_constant > 0.0)) return signal;
  Eigen::MatrixXd column = signal.matrix();
  shared_low_pass(*this, time_constant)->apply(column);
  return column.array();
}

double Frame::pendulum_moment() const { return pendulum_mass() * pendulum_arm() * kGravity; }

void Frame::hang_pendulum() {
  gravity = pendulum_moment() * load_angle.sin();
  torque = gravity + pendulum_mass() * pendulum_arm() * pendulum_arm() * load_acceleration;
  smooth_torque = torque;
}

void Frame::weigh_load() {
  if (torque_by_inertia) torque = load_inertia * load_acceleration;
}

void Frame::measure_torsion() {
  torsion_range = (torsion.abs() * usable).maxCoeff();
  lowest = torsion.minCoeff();
  highest = torsion.maxCoeff();
  rate_range = (torsion_rate.abs() * usable).maxCoeff();
  std::vector<double> rates;
  for (Index i = 0; i < rows(); ++i) {
    if (usable[i] > 0.0) rates.push_back(std::abs(torsion_rate[i]));
  }
  slow_rate = percentile(rates, kSlowest);
}

double Frame::fastest() const {
  const ArrayXd& speed = rig == Rig::free ? load_speed : torsion_rate;
  const ArrayXd& acceleration = rig == Rig::free ? load_acceleration : torsion_acceleration;
  return (acceleration.abs() * usable).maxCoeff() / (speed.abs() * usable).maxCoeff();
}

bool Frame::has(Equation equation) const { return std::ranges::count(equations, equation) > 0; }

}  // namespace flexspline::studies
