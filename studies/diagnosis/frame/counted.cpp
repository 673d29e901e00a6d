#include "diagnosis/frame/counted.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "flexspline/core/counts.hpp"

namespace flexspline::studies {
std::vector<double> counted(std::span<const double> time, std::span<const double> angle,
                            double bandwidth) {
  const double half = std::numbers::pi / bandwidth;
  const double two_levels = 1.99 * level_of_counts(angle);  // but for rounding
  std::vector<double> tells(angle.size());
  std::size_t first = 0;
  std::size_t last = 0;
  for (std::size_t i = 0; i < angle.size(); ++i) {
    while (time[first] < time[i] - half) ++first;
    while (last + 1 < time.size() && time[last + 1] <= time[i] + half) ++last;
    // Nothing faster than every other sample is kept.
    const std::size_t from = std::min(first, i - std::min<std::size_t>(i, 1));
    const std::size_t to = std::max(last, std::min(i + 1, angle.size() - 1));
    tells[i] = std::abs(angle[to] - angle[from]) >= two_levels ? 1.0 : 0.0;
  }
  return tells;
}

std::vector<double> counted_motor(const Recording& recording, double bandwidth) {
  const std::vector<double>* angle = recording.find(Quantity::motor_angle);
  if (angle == nullptr) angle = recording.find(Quantity::load_angle);
  if (angle == nullptr) return std::vector<double>(recording.time.size(), 1.0);
  return counted(recording.time, *angle, bandwidth);
}

std::vector<double> torsion_error(const Recording& recording, Rig rig, double ratio,
                                  const DriveChannels& smooth) {
  if (rig != Rig::locked && rig != Rig::free) return smooth.torsion_error;
  std::vector<double> error = smooth.torsion_error;
  if (rig == Rig::locked) {
    error = smooth.motor_angle_error;
    for (double& one : error) one /= ratio;
  }
  error.resize(recording.time.size());
  for (const auto& [quantity, gear] :
       {std::pair(Quantity::motor_angle, ratio), std::pair(Quantity::load_angle, 1.0)}) {
    const std::vector<double>* angle = recording.find(quantity);
    if (angle == nullptr) continue;
    const double within = level_of_counts(*angle) / (gear * std::sqrt(12.0));
    const auto tells = counted(recording.time, *angle, smooth.motor_bandwidth);
    for (std::size_t i = 0; i < error.size(); ++i) {
      if (tells[i] == 0.0) error[i] = std::hypot(error[i], within);
    }
  }
  return error;
}

}  // namespace flexspline::studies
