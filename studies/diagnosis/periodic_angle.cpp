#include "diagnosis/periodic_angle.hpp"

#include <array>
#include <cmath>

#include <Eigen/Dense>

#include "diagnosis/running_parabola.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

constexpr double kStandsOut = 4.0;  // amplitude over its standard error
constexpr Index kHalfWindow = 50;   // samples
constexpr Index kFewestRows = 64;

double ratio_of(const RecordingSet& set) {
  const auto found = set.constants.find("gear_ratio");
  return found == set.constants.end() ? 1.0 : found->second;
}

std::array<double, 4> orders_of(double ratio) { return {1.0, 2.0, 2.0 * (1.0 + 1.0 / ratio), 4.0}; }

/// Normal equations of the raw torsion over turns, of what changes fast in both.
struct Regression {
  Eigen::MatrixXd normal;
  Eigen::VectorXd right;
};

Eigen::MatrixXd columns_of(const ArrayXd& theta, double ratio, const ArrayXd& weights) {
  const auto orders = orders_of(ratio);
  Eigen::MatrixXd columns(theta.size() - weights.size() + 1, 2 * static_cast<Index>(orders.size()));
  for (std::size_t k = 0; k < orders.size(); ++k) {
    const Index at = 2 * static_cast<Index>(k);
    columns.col(at) = about_parabola((orders[k] * theta).sin(), weights);
    columns.col(at + 1) = about_parabola((orders[k] * theta).cos(), weights);
  }
  return columns;
}

// A recording counts by what its own regression leaves: where the torsion jumps, as in a staircase,
// that is much, and much of it looks like turns.
void gather(const Recording& recording, double ratio, Regression& regression) {
  const auto* motor = recording.find(Quantity::motor_angle);
  const auto* load = recording.find(Quantity::load_angle);
  if (motor == nullptr || load == nullptr) return;
  const Index n = static_cast<Index>(motor->size());
  const ArrayXd theta = Eigen::Map<const ArrayXd>(motor->data(), n);
  const ArrayXd weights = parabola_weights(kHalfWindow);
  const Eigen::VectorXd torsion =
      about_parabola(theta / ratio - Eigen::Map<const ArrayXd>(load->data(), n), weights);
  if (torsion.size() < kFewestRows) return;
  const Eigen::MatrixXd columns = columns_of(theta, ratio, weights);
  const Eigen::MatrixXd normal = columns.transpose() * columns;
  const Eigen::VectorXd right = columns.transpose() * torsion;
  const double left =
      torsion.squaredNorm() - right.dot(normal.completeOrthogonalDecomposition().solve(right));
  const double variance = left / static_cast<double>(torsion.size() - columns.cols());
  if (!(variance > 0.0)) return;
  if (regression.normal.size() == 0) {
    regression.normal = Eigen::MatrixXd::Zero(columns.cols(), columns.cols());
    regression.right = Eigen::VectorXd::Zero(columns.cols());
  }
  regression.normal += normal / variance;
  regression.right += right / variance;
}

}  // namespace

double PeriodicAngle::value(double theta) const {
  double sum = 0.0;
  for (const Term& t : terms) {
    sum += t.sine * std::sin(t.order * theta) + t.cosine * std::cos(t.order * theta);
  }
  return sum;
}

double PeriodicAngle::slope(double theta) const {
  double sum = 0.0;
  for (const Term& t : terms) {
    sum += t.order * (t.sine * std::cos(t.order * theta) - t.cosine * std::sin(t.order * theta));
  }
  return sum;
}

double PeriodicAngle::curvature(double theta) const {
  double sum = 0.0;
  for (const Term& t : terms) {
    sum -= t.order * t.order *
           (t.sine * std::sin(t.order * theta) + t.cosine * std::cos(t.order * theta));
  }
  return sum;
}

PeriodicAngle periodic_angle(const RecordingSet& set) {
  PeriodicAngle periodic;
  if (set.rig != Rig::free) return periodic;
  const double ratio = ratio_of(set);
  Regression regression;
  for (const Recording& recording : set.recordings) gather(recording, ratio, regression);
  if (regression.normal.size() == 0) return periodic;
  const Eigen::VectorXd scale = regression.normal.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd scaled = scale.asDiagonal() * regression.normal * scale.asDiagonal();
  const Eigen::MatrixXd inverse =
      scale.asDiagonal() *
      scaled.ldlt().solve(Eigen::MatrixXd::Identity(scaled.rows(), scaled.cols())) *
      scale.asDiagonal();
  const Eigen::VectorXd b = inverse * regression.right;
  const auto orders = orders_of(ratio);
  for (std::size_t k = 0; k < orders.size(); ++k) {
    const Index at = 2 * static_cast<Index>(k);
    const double amplitude = std::hypot(b[at], b[at + 1]);
    if (amplitude < kStandsOut * std::sqrt(inverse(at, at))) continue;
    periodic.terms.push_back({orders[k], ratio * b[at], ratio * b[at + 1]});
  }
  return periodic;
}

namespace {

// What drives a servo as it is recorded: a torque, a current or a voltage.
DriveSpec unit_drive(const RecordingSet& set) {
  DriveSpec drive;
  drive.gear_ratio = ratio_of(set);
  drive.torque_constant = 1.0;
  drive.resistance = 1.0;
  return drive;
}

}  // namespace

Result<DriveChannels> channels_with(const RecordingSet& set, const Recording& recording,
                                    const PeriodicAngle& periodic) {
  if (periodic.terms.empty()) return drive_channels(set.rig, unit_drive(set), recording);
  Recording plain = recording;
  for (double& theta : plain.channels[Quantity::motor_angle]) theta -= periodic.value(theta);
  auto channels = drive_channels(set.rig, unit_drive(set), plain);
  if (!channels) return channels;
  const auto& raw = *recording.find(Quantity::motor_angle);
  for (std::size_t i = 0; i < raw.size(); ++i) {
    // theta - P(theta) = s: theta by two Newton steps, its rates by differentiating twice.
    double theta = raw[i];
    for (int step = 0; step < 2; ++step) {
      theta -= (theta - periodic.value(theta) - channels->motor_angle[i]) /
               (1.0 - periodic.slope(theta));
    }
    const double stretch = 1.0 / (1.0 - periodic.slope(theta));
    const double speed = channels->motor_speed[i] * stretch;
    channels->motor_acceleration[i] =
        (channels->motor_acceleration[i] + periodic.curvature(theta) * speed * speed) * stretch;
    channels->motor_speed[i] = speed;
    channels->motor_angle[i] = theta;
  }
  return channels;
}

}  // namespace flexspline::studies
