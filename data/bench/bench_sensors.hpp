#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "flexspline/data/bench.hpp"

namespace flexspline::data {

/// The motor's encoder: gear ratio * (phi + noise), rounded to the encoder's step. rad.
std::vector<double> measured_motor_angle(const std::vector<double>& position,
                                         const BenchSensors& sensors, std::uint64_t seed,
                                         std::string_view id);

/// The torque sensor: torque + white noise + first-order coloured noise. Nm.
std::vector<double> measured_torque(const std::vector<double>& torque, const BenchSensors& sensors,
                                    std::uint64_t seed, std::string_view id);

/// Time stamps: what the clock says of the true instants.
std::vector<double> measured_time(const std::vector<double>& time, const BenchSensors& sensors,
                                  std::uint64_t seed, std::string_view id);

/// Which samples are in the table; the first and the last always.
std::vector<bool> samples_kept(std::size_t count, const BenchSensors& sensors, std::uint64_t seed,
                               std::string_view id);

}  // namespace flexspline::data
