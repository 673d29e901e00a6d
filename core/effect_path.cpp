#include "flexspline/core/effect_path.hpp"

#include <algorithm>

namespace flexspline {

std::vector<Instant<double>> instants_of(const Motion& motion) {
  std::vector<Instant<double>> path(motion.time.size());
  for (std::size_t i = 0; i < path.size(); ++i) {
    Instant<double>& x = path[i];
    x.time = motion.time[i];
    x.torsion = x.motor_angle = x.load_angle = motion.position[i];
    x.torsion_rate = x.motor_speed = x.load_speed = motion.velocity[i];
    x.torsion_acceleration = x.motor_acceleration = x.load_acceleration = motion.acceleration[i];
  }
  return path;
}

void set_torque(std::span<Instant<double>> path, std::span<const double> torque) {
  const std::size_t n = path.size();
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t before = i > 0 ? i - 1 : 0;
    const std::size_t after = std::min(i + 1, n - 1);
    path[i].transmitted_torque = torque[i];
    path[i].transmitted_torque_rate =
        after > before ? (torque[after] - torque[before]) / (path[after].time - path[before].time)
                       : 0.0;
  }
}

Result<std::vector<double>> terms_along(const EffectRow& row, const EffectSpec& spec,
                                        std::span<const Instant<double>> path) {
  const auto values = parameter_values(row, spec);
  if (!values) return tl::unexpected(values.error());
  std::vector<Instant<double>> across;
  if (spec.across) {
    std::ranges::transform(path, std::back_inserter(across), across_transmission<double>);
    path = across;
  }
  std::vector<double> states(state_count(row, values->size()), 0.0);
  std::vector<double> terms(path.size());
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (i > 0 && row.real.advance != nullptr) {
      row.real.advance(path[i - 1], path[i], *values, states);
    }
    terms[i] = row.real.term(path[i], *values, states);
  }
  return terms;
}

Result<void> apply_along(const EffectRow& row, const EffectSpec& spec,
                         std::span<const Instant<double>> path, std::span<double> signal) {
  if (row.map != nullptr) {
    const auto values = parameter_values(row, spec);
    if (!values) return tl::unexpected(values.error());
    std::vector<double> time(path.size());
    std::ranges::transform(path, time.begin(), &Instant<double>::time);
    row.map(time, signal, *values);
    return {};
  }
  const auto terms = terms_along(row, spec, path);
  if (!terms) return tl::unexpected(terms.error());
  for (std::size_t i = 0; i < signal.size(); ++i) signal[i] += (*terms)[i];
  return {};
}

}  // namespace flexspline
