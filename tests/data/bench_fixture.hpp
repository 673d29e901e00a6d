#pragma once

#include <cstddef>
#include <string>

#include "bench/table_one.hpp"
#include "flexspline/data/bench.hpp"

namespace flexspline::data {

/// A recording of a truth of the catalogue, five cycles of 500 samples.
inline BenchRecording record(const std::string& truth, double amplitude, double frequency,
                             const BenchSensors& sensors = {}, std::uint64_t seed = 1,
                             const std::string& id = "sine") {
  const BenchTruth made = find_truth(truth).value()->make();
  return make_recording(made, {amplitude, frequency, 5, 500}, sensors, seed, id).value();
}

/// Work done on the drive in one cycle, J: tau phi' over time, which the trapezoidal rule sums to
/// rounding where both are trigonometric polynomials of low order.
inline double loss_of_cycle(const BenchRecording& made, int cycle) {
  double sum = 0.0;
  const auto first = static_cast<std::size_t>(cycle) * 500;
  for (std::size_t k = first; k < first + 500; ++k) sum += made.torque[k] * made.motion.velocity[k];
  return sum * made.motion.time[1];
}

}  // namespace flexspline::data
