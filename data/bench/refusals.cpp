#include "bench/refusals.hpp"

#include <cmath>
#include <string_view>

#include <fmt/format.h>

namespace flexspline::data {
namespace {

constexpr int kFewestSamples = 16;
constexpr int kMostSamples = 100'000'000;

/// Collects the first setting that breaks its rule.
class Check {
 public:
  void require(bool holds, std::string_view setting, double value, std::string_view rule) {
    if (holds || error_) return;
    error_ = Error{ErrorCode::usage,
                   fmt::format("{} = {} is not possible on the bench", setting, value),
                   fmt::format("give {} {}", setting, rule),
                   {}};
  }
  void positive(std::string_view setting, double value) {
    require(std::isfinite(value) && value > 0.0, setting, value, "as a finite number above 0");
  }
  void not_negative(std::string_view setting, double value) {
    require(std::isfinite(value) && value >= 0.0, setting, value, "as a finite number, 0 or above");
  }
  std::optional<Error> error() && { return std::move(error_); }

 private:
  std::optional<Error> error_;
};

void check_excitation(Check& check, const BenchExcitation& excitation) {
  check.positive("amplitude (rad)", excitation.amplitude);
  check.positive("frequency_hz", excitation.frequency_hz);
  check.require(excitation.cycles >= 1, "cycles", excitation.cycles, "as 1 or more");
  check.require(excitation.samples_per_cycle >= kFewestSamples, "samples_per_cycle",
                excitation.samples_per_cycle, "as 16 or more");
  check.require(
      static_cast<double>(excitation.cycles) * excitation.samples_per_cycle <= kMostSamples,
      "cycles", excitation.cycles, "so that a recording has at most 1e8 samples");
}

void check_sensors(Check& check, const BenchSensors& sensors) {
  check.not_negative("encoder_step (rad)", sensors.encoder_step);
  check.not_negative("angle_noise", sensors.angle_noise);
  check.not_negative("torque_noise_white", sensors.torque_noise_white);
  check.not_negative("torque_noise_coloured", sensors.torque_noise_coloured);
  check.positive("torque_noise_samples", sensors.torque_noise_samples);
  check.not_negative("time_jitter", sensors.time_jitter);
  check.require(sensors.missing_samples >= 0.0 && sensors.missing_samples <= 0.9, "missing_samples",
                sensors.missing_samples, "as a share between 0 and 0.9");
}

void check_truth(Check& check, const BenchTruth& truth) {
  check.not_negative("sensor_lag_s", truth.sensor_lag_s);
  for (const auto& [stiffness, yield] : truth.slip_elements) {
    check.not_negative("stiffness of a slip element (Nm/rad)", stiffness);
    check.positive("yield of a slip element (rad)", yield);
  }
}

}  // namespace

std::optional<Error> refusal(const BenchTruth& truth, const BenchExcitation& excitation,
                             const BenchSensors& sensors) {
  expects(truth.stiffness && truth.damping && truth.log_modulation,
          "a truth of the bench has f, g^-1 and ln h");
  Check check;
  check_excitation(check, excitation);
  check_sensors(check, sensors);
  check_truth(check, truth);
  return std::move(check).error();
}

}  // namespace flexspline::data
