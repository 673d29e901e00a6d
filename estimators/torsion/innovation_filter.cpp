#include "torsion/innovation_filter.hpp"

#include <algorithm>
#include <cmath>

#include "uncertainty/covariance.hpp"

namespace flexspline::estimators {
namespace {

constexpr double kLeastError = 0.01;  // of a sample's noise, however many went into the mean

// Noise of the torque counts at the low frequencies that the gear follows. Smoothing has taken its
// own share of them out of the residual, so a ratio below one says nothing.
double colour(const PreparedRecord& record) {
  std::vector<double> residual(record.record.effort.size());
  for (std::size_t i = 0; i < residual.size(); ++i) {
    residual[i] = record.record.effort[i] - record.smooth.effort[i];
  }
  return std::max(1.0, long_run_ratio(residual));
}

}  // namespace

InnovationFilter::InnovationFilter(const PreparedRecord& record, std::span<const double> decay,
                                   std::span<const double> gain) {
  const double coloured = colour(record);
  const auto& time = record.record.time;
  double variance = 0.0;
  double transition = 1.0;
  if (record.rows.empty()) return;  // nothing to weigh
  double sigma = record.effort_sigma.front();
  std::size_t next = 0;
  for (std::size_t i = 0; i < time.size() && next < record.rows.size(); ++i) {
    if (record.rows[next] == i) {
      const double error =
          std::max(record.smooth.motion_error[i], kLeastError * record.motion_sigma);
      const double innovation = variance + error * error;
      const double update = variance / innovation;
      steps_.push_back({transition, update, 1.0 / std::sqrt(innovation)});
      variance *= 1.0 - update;
      transition = 1.0;
      sigma = record.effort_sigma[next++];
    }
    if (i + 1 == time.size()) break;
    const double dt = time[i + 1] - time[i];
    const double z = 0.5 * (decay[i] + decay[i + 1]) * dt;
    const double held = std::abs(z) > 1e-9 ? std::expm1(z) / z : 1.0;
    const double driven = 0.5 * (gain[i] + gain[i + 1]) * dt * held;
    variance = std::exp(2.0 * z) * variance + driven * driven * sigma * sigma * coloured;
    transition *= std::exp(z);
  }
}

void InnovationFilter::whiten(std::span<double> residual, std::span<double> jacobian,
                              std::size_t width) const {
  double deviation = 0.0;
  std::vector<double> deviations(jacobian.empty() ? 0 : width, 0.0);
  for (std::size_t r = 0; r < steps_.size(); ++r) {
    const Step& step = steps_[r];
    deviation *= step.transition;
    const double innovation = residual[r] - deviation;
    deviation += step.update * innovation;
    residual[r] = innovation * step.weight;
    for (std::size_t k = 0; k < deviations.size(); ++k) {
      double& entry = jacobian[r * width + k];
      const double predicted = deviations[k] * step.transition;
      const double change = entry - predicted;
      deviations[k] = predicted + step.update * change;
      entry = change * step.weight;
    }
  }
}

}  // namespace flexspline::estimators
