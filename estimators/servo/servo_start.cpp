#include "servo/servo_start.hpp"

#include <cmath>

#include <fmt/format.h>
#include <Eigen/Core>

#include "flexspline/core/rig_residuals.hpp"
#include "flexspline/estimators/bounded_least_squares.hpp"

namespace flexspline::estimators {
namespace {

constexpr double kSignWidth = 0.1;  // rad/s; of the equation error alone

Result<double> constant(const RecordingSet& set, const std::string& name) {
  const auto found = set.constants.find(name);
  if (found != set.constants.end()) return found->second;
  return failure(
      ErrorCode::input_missing,
      fmt::format("{}: no constant {}, which scales the torques of a servo", set.name, name),
      "state it under [constants] in dataset.toml");
}

/// Adds a recording's rows to the normal equations.
Result<void> add(const DriveSpec& drive, const Recording& recording, Eigen::MatrixXd& normal,
                 Eigen::VectorXd& right) {
  const auto c = drive_channels(Rig::servo, drive, recording);
  if (!c) return tl::unexpected(c.error());
  const auto* duty = recording.find(Quantity::duty_cycle);
  const auto* supply = recording.find(Quantity::supply_voltage);
  const auto* enabled = recording.find(Quantity::drive_enabled);
  const double pull = drive.load_mass * drive.arm_length;
  for (std::size_t i = 0; i < c->time.size(); ++i) {
    const bool on = enabled == nullptr || (*enabled)[i] >= 0.5;
    const double w = c->load_speed[i];
    const double a = c->load_acceleration[i];
    const Eigen::Vector4d row(on ? (*duty)[i] * (*supply)[i] : 0.0, on ? -w : 0.0, -a,
                              -std::tanh(w / kSignWidth));
    const double load = pull * (drive.gravity * std::sin(c->load_angle[i]) + drive.arm_length * a);
    normal += row * row.transpose();
    right += row * load;
  }
  return {};
}

}  // namespace

Result<DriveSpec> servo_start(const RecordingSet& set,
                              const std::vector<const Recording*>& recordings) {
  const auto mass = constant(set, "load_mass_kg");
  if (!mass) return tl::unexpected(mass.error());
  const auto arm = constant(set, "arm_length_m");
  if (!arm) return tl::unexpected(arm.error());
  DriveSpec drive;
  drive.load_mass = *mass;
  drive.arm_length = *arm;
  drive.load_inertia = *mass * *arm * *arm;
  drive.torque_constant = drive.back_emf = drive.resistance = 1.0;
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(4, 4);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(4);
  for (const Recording* one : recordings) {
    if (auto added = add(drive, *one, normal, right); !added) return tl::unexpected(added.error());
  }
  const Eigen::VectorXd b = bounded_least_squares(normal, right, Eigen::VectorXd::Zero(4));
  if (!(b[0] > 0.0 && b[1] > 0.0)) {
    return failure(
        ErrorCode::numerics,
        fmt::format("the equation error gives kt/R = {:.3g} and kt ke/R = {:.3g}", b[0], b[1]),
        "record motions of higher speed under load");
  }
  drive.torque_constant = drive.back_emf = b[1] / b[0];
  drive.resistance = drive.torque_constant / b[0];
  drive.motor_inertia = std::max(b[2], 0.01 * drive.load_inertia);
  return drive;
}

}  // namespace flexspline::estimators
