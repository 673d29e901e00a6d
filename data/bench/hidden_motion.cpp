#include "bench/hidden_motion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "bench/hidden_draw.hpp"

namespace flexspline::data {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr std::array<double, 5> kHarmonics = {1.0, 2.0, 3.0, 5.0, 7.0};
constexpr std::array<double, 6> kLevels = {0.5, 1.0, 0.25, -0.5, -1.0, 0.0};

}  // namespace

HeldMotion::HeldMotion(const HiddenExcitation& excitation, std::uint64_t seed, std::string_view id)
    : excitation_(excitation) {
  switch (excitation.motion) {
    case HiddenMotion::sine:
      break;
    case HiddenMotion::multisine:
      plan_multisine(seed, id);
      break;
    case HiddenMotion::step_hold:
      plan_levels();
      break;
    case HiddenMotion::ramp:
      plan_speeds(std::vector<double>(
          std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(excitation.cycles))), 1.0));
      break;
    case HiddenMotion::staircase:
      plan_speeds({1.0, 2.0, 4.0});
      break;
  }
}

void HeldMotion::plan_multisine(std::uint64_t seed, std::string_view id) {
  for (std::size_t k = 0; k < kHarmonics.size(); ++k) {
    phases_.push_back(drawn(seed, id, k, 0.0, kTurn));
  }
  double crest = 0.0;
  for (int k = 0; k < 1000; ++k) {
    crest = std::max(crest, std::abs(multisine(k / (1000.0 * excitation_.frequency_hz)).value));
  }
  crest_ = crest;
}

void HeldMotion::plan_levels() {
  const double leg = duration() / static_cast<double>(kLevels.size());
  width_ = 0.15 * leg;
  double level = 0.0;
  for (std::size_t k = 0; k < kLevels.size(); ++k) {
    changes_.push_back({leg * (static_cast<double>(k) + 0.1), kLevels[k] - level});
    level = kLevels[k];
  }
}

/// Four legs of the same travel a speed: out and back on either side.
void HeldMotion::plan_speeds(const std::vector<double>& speeds) {
  double legs = 0.0;
  for (const double speed : speeds) legs += 4.0 / speed;
  const double unit = 0.96 * duration() / legs;  // s of a leg at speed 1
  width_ = 0.2 * unit / *std::ranges::max_element(speeds);
  double time = 0.0;
  double last = 0.0;
  for (const double speed : speeds) {
    for (const double sign : {1.0, -1.0, -1.0, 1.0}) {
      changes_.push_back({time, (sign * speed - last) / unit});
      last = sign * speed;
      time += unit / speed;
    }
  }
  changes_.push_back({time, -last / unit});
}

Jet HeldMotion::multisine(double t) const {
  Jet sum;
  for (std::size_t k = 0; k < kHarmonics.size(); ++k) {
    const double rate = kTurn * excitation_.frequency_hz * kHarmonics[k];
    sum = sum + (1.0 / std::sqrt(kHarmonics[k])) * sine(rate, phases_[k], t);
  }
  return sum;
}

Jet HeldMotion::at(double t) const {
  const double f = excitation_.frequency_hz;
  Jet shape;
  switch (excitation_.motion) {
    case HiddenMotion::sine:
      shape = soft_step(t, 0.5 / f) * sine(kTurn * f, 0.0, t);
      break;
    case HiddenMotion::multisine:
      shape = (1.0 / crest_) * (soft_step(t, 0.5 / f) * multisine(t));
      break;
    case HiddenMotion::step_hold:
      for (const Change& x : changes_) shape = shape + x.by * soft_step(t - x.time, width_);
      break;
    case HiddenMotion::ramp:
    case HiddenMotion::staircase:
      for (const Change& x : changes_) shape = shape + x.by * soft_ramp(t - x.time, width_);
      break;
  }
  return excitation_.amplitude * shape;
}

}  // namespace flexspline::data
