#include "diagnosis/frame/periodic_angle.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include <Eigen/Dense>

#include "diagnosis/frame/accelerations.hpp"
#include "diagnosis/frame/running.hpp"
#include "diagnosis/frame/smoothed.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

// Amplitude over its standard error: starts from one angle look like turns at up to 7.
constexpr double kStandsOut = 10.0;
constexpr Index kHalfWindow = 50;  // samples
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
std::optional<Regression> regression_of(const Recording& recording, double ratio) {
  const auto* motor = recording.find(Quantity::motor_angle);
  const auto* load = recording.find(Quantity::load_angle);
  if (motor == nullptr || load == nullptr) return std::nullopt;
  const Index n = static_cast<Index>(motor->size());
  const ArrayXd theta = Eigen::Map<const ArrayXd>(motor->data(), n);
  const ArrayXd weights = parabola_weights(kHalfWindow);
  const Eigen::VectorXd torsion =
      about_parabola(theta / ratio - Eigen::Map<const ArrayXd>(load->data(), n), weights);
  if (torsion.size() < kFewestRows) return std::nullopt;
  const Eigen::MatrixXd columns = columns_of(theta, ratio, weights);
  const Eigen::MatrixXd normal = columns.transpose() * columns;
  const Eigen::VectorXd right = columns.transpose() * torsion;
  const double left =
      torsion.squaredNorm() - right.dot(normal.completeOrthogonalDecomposition().solve(right));
  const double variance = left / static_cast<double>(torsion.size() - columns.cols());
  if (!(variance > 0.0)) return std::nullopt;
  return Regression{normal / variance, right / variance};
}

/// Coefficients of all recordings, and their covariance.
struct Common {
  Eigen::VectorXd b;
  Eigen::MatrixXd white;    ///< of independent samples
  Eigen::MatrixXd between;  ///< by the scatter from recording to recording (Liang and Zeger 1986)
};

Common common_of(const std::vector<Regression>& all) {
  Regression sum = all.front();
  for (std::size_t i = 1; i < all.size(); ++i) {
    sum.normal += all[i].normal, sum.right += all[i].right;
  }
  const Eigen::VectorXd scale = sum.normal.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd scaled = scale.asDiagonal() * sum.normal * scale.asDiagonal();
  Common c;
  c.white = scale.asDiagonal() *
            scaled.ldlt().solve(Eigen::MatrixXd::Identity(scaled.rows(), scaled.cols())) *
            scale.asDiagonal();
  c.b = c.white * sum.right;
  c.between = Eigen::MatrixXd::Zero(scaled.rows(), scaled.cols());
  for (const Regression& one : all) {
    const Eigen::VectorXd off = c.white * (one.right - one.normal * c.b);
    c.between += off * off.transpose();
  }
  return c;
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

ArrayXd PeriodicAngle::rate(const ArrayXd& theta, const ArrayXd& speed) const {
  if (terms.empty()) return {};
  return theta.unaryExpr([&](double x) { return slope(x); }) * speed;
}

PeriodicAngle periodic_angle(const RecordingSet& set) {
  PeriodicAngle periodic;
  if (set.rig != Rig::free) return periodic;
  const double ratio = ratio_of(set);
  std::vector<Regression> regressions;
  for (const Recording& recording : set.recordings) {
    if (auto one = regression_of(recording, ratio)) regressions.push_back(std::move(*one));
  }
  if (regressions.empty()) return periodic;
  const Common common = common_of(regressions);
  const auto orders = orders_of(ratio);
  for (std::size_t k = 0; k < orders.size(); ++k) {
    const Index at = 2 * static_cast<Index>(k);
    const double amplitude = common.b.segment<2>(at).norm();
    // What one recording has of its own, as the counts of its encoders at one speed, is no turn.
    const double error = std::sqrt(
        std::max(common.white(at, at), 0.5 * common.between.diagonal().segment<2>(at).sum()));
    if (amplitude < kStandsOut * error) continue;
    periodic.terms.push_back({orders[k], ratio * common.b[at], ratio * common.b[at + 1]});
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

// Both angles turn by far more than the gear winds up, and each is smoothed in its own way: what
// the ways differ by is as large as a torsion. So that of the torsion is smoothed as it is.
Result<void> smooth_torsion(double ratio, const Recording& recording, DriveChannels& channels) {
  const auto* motor = recording.find(Quantity::motor_angle);
  const auto* load = recording.find(Quantity::load_angle);
  if (motor == nullptr || load == nullptr) return {};
  std::vector<double> torsion;
  for (std::size_t i = 0; i < motor->size(); ++i) {
    torsion.push_back((*motor)[i] / ratio - (*load)[i]);
  }
  auto smooth = smoothed(recording, std::move(torsion), Resolution::fine);
  if (!smooth) return tl::unexpected(smooth.error());
  channels.torsion = std::move(smooth->torsion);
  channels.torsion_rate = std::move(smooth->torsion_rate);
  channels.torsion_acceleration = std::move(smooth->torsion_acceleration);
  channels.torsion_error = std::move(smooth->torsion_error);
  channels.torsion_rate_error = std::move(smooth->torsion_rate_error);
  return {};
}

Result<DriveChannels> smooth_channels(const RecordingSet& set, const Recording& recording) {
  const bool drives = set.rig != Rig::specimen;
  auto channels =
      drive_channels(set.rig, unit_drive(set), recording, resolution_on(set.rig),
                     drives ? std::span<const double>(kNarrower) : std::span<const double>{});
  if (!channels || set.rig != Rig::free) return channels;
  if (auto torsion = smooth_torsion(ratio_of(set), recording, *channels); !torsion) {
    return tl::unexpected(torsion.error());
  }
  return channels;
}

}  // namespace

Result<DriveChannels> channels_with(const RecordingSet& set, const Recording& recording,
                                    const PeriodicAngle& periodic) {
  if (periodic.terms.empty()) return smooth_channels(set, recording);
  Recording plain = recording;
  for (double& theta : plain.channels[Quantity::motor_angle]) theta -= periodic.value(theta);
  auto channels = smooth_channels(set, plain);
  if (!channels) return channels;
  const double ratio = ratio_of(set);
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
    const auto whole = [&](double smoothed) {
      return (smoothed + periodic.curvature(theta) * speed * speed) * stretch;
    };
    const double acceleration = whole(channels->motor_acceleration[i]);
    for (auto& narrower : channels->narrower) narrower.motor[i] = whole(narrower.motor[i]);
    channels->torsion[i] += (theta - channels->motor_angle[i]) / ratio;
    channels->torsion_rate[i] += (speed - channels->motor_speed[i]) / ratio;
    channels->torsion_acceleration[i] += (acceleration - channels->motor_acceleration[i]) / ratio;
    channels->motor_acceleration[i] = acceleration;
    channels->motor_speed[i] = speed;
    channels->motor_angle[i] = theta;
  }
  return channels;
}

}  // namespace flexspline::studies
