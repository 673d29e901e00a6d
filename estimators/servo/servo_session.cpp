#include "servo/servo_session.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace flexspline::estimators {
namespace {

constexpr double kGap = 1.0;  // s between recordings on the common clock

constexpr Quantity kInputs[] = {Quantity::duty_cycle, Quantity::supply_voltage,
                                Quantity::drive_enabled};

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

Result<ServoClock> servo_clock(const std::vector<const Recording*>& recordings) {
  ServoClock clock;
  double next = 0.0;
  for (const Recording* one : recordings) {
    clock.start.push_back(next);
    next += one->time.back() - one->time.front() + kGap;
  }
  for (const Quantity quantity : kInputs) {
    std::vector<Signal> parts;
    for (std::size_t r = 0; r < recordings.size(); ++r) {
      const auto* samples = recordings[r]->find(quantity);
      if (samples == nullptr && quantity == Quantity::drive_enabled) break;
      if (samples == nullptr) {
        return failure(ErrorCode::input_missing,
                       fmt::format("recording {} has no {}, by which a servo is driven",
                                   recordings[r]->id, name_of(quantity)),
                       "record it and name it in dataset.toml");
      }
      std::vector<double> time = recordings[r]->time;
      for (double& t : time) t += clock.start[r] - recordings[r]->time.front();
      parts.push_back(sampled_signal(time, *samples));
    }
    if (parts.size() < recordings.size()) continue;
    clock.inputs.channels.emplace(quantity, spliced(clock.start, std::move(parts)));
  }
  return clock;
}

}  // namespace flexspline::estimators
