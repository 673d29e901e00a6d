#include "servo/servo_session.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace flexspline::estimators {
namespace {

constexpr double kGap = 1.0;  // s between recordings on the common clock

constexpr double kOpen = 0.98;      // duty cycle beyond which the bridge may be full
constexpr double kFaithful = 0.05;  // of the duty cycle's size: what a loop may leave unexplained

std::vector<Quantity> inputs_of(ServoDuty duty) {
  const auto first = duty == ServoDuty::recorded ? Quantity::duty_cycle : Quantity::commanded_angle;
  return {first, Quantity::supply_voltage, Quantity::drive_enabled};
}

/// Duty cycle a radian of error of the loop that ran while this was recorded.
Result<double> loop_gain(const Recording& recording) {
  const auto* duty = recording.find(Quantity::duty_cycle);
  const auto* angle = recording.find(Quantity::load_angle);
  const auto* goal = recording.find(Quantity::commanded_angle);
  const auto* on = recording.find(Quantity::drive_enabled);
  if (duty == nullptr || angle == nullptr || goal == nullptr) {
    return failure(ErrorCode::input_missing,
                   fmt::format("recording {} does not show its position loop", recording.id),
                   "record duty_cycle, load_angle and commanded_angle, or take the duty cycle as "
                   "recorded");
  }
  double cross = 0.0;
  double errors = 0.0;
  double duties = 0.0;
  for (std::size_t i = 0; i < duty->size(); ++i) {
    if (std::abs((*duty)[i]) > kOpen || (on != nullptr && (*on)[i] < 0.5)) continue;
    const double error = (*goal)[i] - (*angle)[i];
    cross += (*duty)[i] * error;
    errors += error * error;
    duties += (*duty)[i] * (*duty)[i];
  }
  const double gain = cross / errors;
  if (gain > 0.0 && duties - gain * cross <= kFaithful * kFaithful * duties) return gain;
  return failure(ErrorCode::bad_data,
                 fmt::format("the duty cycle of recording {} is not in proportion to commanded "
                             "less measured angle",
                             recording.id),
                 "take the duty cycle as recorded");
}

/// The signal of the recording that runs at an instant.
Signal spliced(std::vector<double> starts, std::vector<Signal> parts) {
  const auto running = [starts](double t) {
    const auto next = std::ranges::upper_bound(starts, t + 0.5 * kGap);
    return next == starts.begin() ? std::size_t{0}
                                  : static_cast<std::size_t>(next - starts.begin()) - 1;
  };
  return {.value = [=](double t) { return parts[running(t)].value(t); },
          .rate = [=](double t) { return parts[running(t)].rate(t); }};
}

}  // namespace

Result<ServoClock> servo_clock(const std::vector<const Recording*>& recordings, ServoDuty duty) {
  ServoClock clock;
  double next = 0.0;
  for (const Recording* one : recordings) {
    clock.start.push_back(next);
    next += one->time.back() - one->time.front() + kGap;
  }
  for (const Quantity quantity : inputs_of(duty)) {
    std::vector<Signal> parts;
    for (std::size_t r = 0; r < recordings.size(); ++r) {
      const auto* samples = recordings[r]->find(quantity);
      if (samples == nullptr && quantity == Quantity::drive_enabled) break;
      if (samples == nullptr) {
        return failure(ErrorCode::input_missing,
                       fmt::format("recording {} has no {}, by which a servo is driven",
                                   recordings[r]->id, name_of(quantity)),
                       "record it and name it in dataset.toml; where the motor's torque or current "
                       "is recorded, flexspline diagnose fits the whole servo");
      }
      std::vector<double> time = recordings[r]->time;
      for (double& t : time) t += clock.start[r] - recordings[r]->time.front();
      parts.push_back(sampled_signal(time, *samples));
    }
    if (parts.size() < recordings.size()) continue;
    clock.inputs.channels.emplace(quantity, spliced(clock.start, std::move(parts)));
  }
  if (duty == ServoDuty::recorded) return clock;
  std::vector<Signal> gains;
  for (const Recording* one : recordings) {
    const auto gain = loop_gain(*one);
    if (!gain) return tl::unexpected(gain.error());
    gains.push_back(
        {.value = [g = *gain](double) { return g; }, .rate = [](double) { return 0.0; }});
  }
  clock.inputs.position_gain = spliced(clock.start, std::move(gains));
  return clock;
}

}  // namespace flexspline::estimators
