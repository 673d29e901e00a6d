#include "bench/hidden_refusals.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

namespace flexspline::data {
namespace {

Error usage(std::string problem, std::string remedy) {
  return Error{ErrorCode::usage, std::move(problem), std::move(remedy), {}};
}

/// The range [low, high] of a setting by name.
struct Setting {
  const char* name;
  double value;
  double low;
  double high;
};

std::optional<Error> first_outside(std::initializer_list<Setting> settings) {
  for (const Setting& s : settings) {
    if (s.value >= s.low && s.value <= s.high) continue;
    return usage(fmt::format("{} = {} is not possible on the bench", s.name, s.value),
                 fmt::format("give {} between {} and {}", s.name, s.low, s.high));
  }
  return std::nullopt;
}

std::optional<Error> refusal(const HiddenExcitation& x) {
  return first_outside({{"amplitude (rad)", x.amplitude, 1e-9, 1e3},
                        {"frequency_hz", x.frequency_hz, 1e-6, 1e4},
                        {"cycles", x.cycles, 0.5, 1e4},
                        {"samples", static_cast<double>(x.samples), 16.0, 1e7}});
}

std::optional<Error> refusal(const HiddenNuisances& n) {
  return first_outside({{"torque_noise", n.torque_noise, 0.0, 1.0},
                        {"coloured_share", n.coloured_share, 0.0, 1.0},
                        {"coloured_samples", n.coloured_samples, 1e-3, 1e6},
                        {"motor_encoder_step (rad)", n.motor_encoder_step, 0.0, 1.0},
                        {"load_encoder_step (rad)", n.load_encoder_step, 0.0, 1.0},
                        {"time_jitter", n.time_jitter, 0.0, 0.2},
                        {"angle_zero (rad)", n.angle_zero, -1.0, 1.0},
                        {"torque_offset", n.torque_offset, -1e3, 1e3},
                        {"motor_torque_offset", n.motor_torque_offset, -1e3, 1e3},
                        {"zero_spread (rad)", n.zero_spread, 0.0, 1.0},
                        {"temperature_spread (K)", n.temperature_spread, 0.0, 20.0},
                        {"load_zero (rad)", n.load_zero, -1.0, 1.0},
                        {"filter_samples", n.filter_samples, 0.0, 100.0}});
}

}  // namespace

std::optional<Error> refusal(const HiddenBench& bench) {
  expects(bench.gear.stiffness && bench.gear.damping && bench.gear.modulation,
          "a gear of the bench has f, g^-1 and h");
  if (bench.design.empty()) return usage("the design has no excitation", "give it one");
  for (const HiddenExcitation& excitation : bench.design) {
    if (auto error = refusal(excitation)) return error;
  }
  if (bench.travels && bench.rig != Rig::specimen) {
    return usage(fmt::format("rig \"{}\" cannot be a joint", name_of(bench.rig)),
                 "let a specimen travel");
  }
  const int tail = bench.nuisances.tail_degrees;
  if (tail != 0 && tail < 3) {
    return usage(fmt::format("tail_degrees = {} leaves noise without a variance", tail),
                 "give 3 or more, or 0 for normal noise");
  }
  return refusal(bench.nuisances);
}

std::optional<Error> refusal(const HiddenBench& bench, const std::vector<HiddenEffect>& effects) {
  std::set<std::string> taken;
  for (const HiddenEffect& effect : effects) {
    const auto row = find_hidden_effect(effect.id);
    if (!row) return row.error();
    if (!taken.insert(effect.id).second) {
      return usage(fmt::format("effect \"{}\" is asked for twice", effect.id), "give it one size");
    }
    if (!(*row)->shows_on(bench.kind())) {
      return usage(
          fmt::format("rig \"{}\" cannot show effect \"{}\"", name_of(bench.kind()), effect.id),
          "choose another rig or another effect");
    }
    if (auto error = first_outside({{"size_fraction", effect.size_fraction, 0.0, 0.5}})) {
      return in_context(*error, effect.id);
    }
  }
  return std::nullopt;
}

}  // namespace flexspline::data
