#include "torsion/prepared_record.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace flexspline::estimators {
namespace {

// Smallest change between samples: the step of an encoder, or zero for a continuous signal.
double encoder_step(const std::vector<double>& motion) {
  double step = std::numeric_limits<double>::infinity();
  std::size_t repeats = 0;
  for (std::size_t i = 1; i < motion.size(); ++i) {
    const double change = std::abs(motion[i] - motion[i - 1]);
    if (change == 0.0) {
      ++repeats;
    } else {
      step = std::min(step, change);
    }
  }
  return repeats * 100 > motion.size() ? step : 0.0;
}

// Where a record has a steady part only that has residuals: in a run-up the derivatives of the
// motion are known from a smoothing spline alone, and its errors are not those of the bench. The
// run-up is simulated and carries the state along.
std::vector<std::size_t> rows_of(const TorsionRecord& record,
                                 const std::optional<SteadyPart>& steady, std::size_t most) {
  const std::size_t first = steady ? steady->first : 0;
  const std::size_t last = steady ? steady->last : record.time.size();
  const std::size_t stride = (last - first + most - 1) / most;
  std::vector<std::size_t> rows;
  for (std::size_t i = first; i < last; i += stride) {
    if (record.valid.empty() || record.valid[i]) rows.push_back(i);
  }
  return rows;
}

}  // namespace

Result<std::vector<PreparedRecord>> prepare(const std::vector<TorsionRecord>& records,
                                            std::size_t most_rows) {
  std::vector<PreparedRecord> prepared;
  for (const auto& record : records) {
    auto smooth = reconstruct(record);
    if (!smooth) return tl::unexpected(in_context(smooth.error(), "recording " + record.id));
    const auto& t = record.time;
    const auto& m = smooth->motion;
    PreparedRecord one{.record = record,
                       .smooth = *smooth,
                       .position = Spline(t, m.position),
                       .velocity = Spline(t, m.velocity),
                       .acceleration = Spline(t, m.acceleration),
                       .effort = Spline(t, smooth->effort),
                       .rows = rows_of(record, smooth->steady, most_rows)};
    if (one.rows.empty()) {
      return failure(ErrorCode::numerics,
                     "recording " + record.id + ": no sample that could be fitted is valid",
                     "leave it out, or correct its channel valid");
    }
    const double quantisation = encoder_step(record.motion) / std::sqrt(12.0);
    const double range =
        *std::ranges::max_element(m.position) - *std::ranges::min_element(m.position);
    one.motion_sigma = std::max({smooth->motion_noise, quantisation, 1e-6 * range});
    one.effort_noise = smooth->effort_noise;
    prepared.push_back(std::move(one));
  }
  double peak = 0.0;
  for (const auto& one : prepared) {
    for (double y : one.smooth.effort) peak = std::max(peak, std::abs(y));
  }
  for (auto& one : prepared) {
    one.effort_noise = std::max(one.effort_noise, 1e-6 * peak);
    one.effort_sigma.assign(one.rows.size(), one.effort_noise);
  }
  return prepared;
}

double centre_of(const PreparedRecord& record) {
  const auto [low, high] = std::ranges::minmax(record.smooth.motion.position);
  return 0.5 * (low + high);
}

Ranges ranges_of(const std::vector<PreparedRecord>& records, bool centred) {
  Ranges ranges;
  ranges.lowest_motion = std::numeric_limits<double>::infinity();
  ranges.highest_motion = -ranges.lowest_motion;
  ranges.shortest_period = std::numeric_limits<double>::infinity();
  for (const auto& one : records) {
    const double centre = centred ? centre_of(one) : 0.0;
    const auto& m = one.smooth.motion;
    for (std::size_t i = 0; i < m.time.size(); ++i) {
      const double x = m.position[i] - centre;
      ranges.lowest_motion = std::min(ranges.lowest_motion, x);
      ranges.highest_motion = std::max(ranges.highest_motion, x);
      ranges.velocity = std::max(ranges.velocity, std::abs(m.velocity[i]));
      ranges.acceleration = std::max(ranges.acceleration, std::abs(m.acceleration[i]));
      ranges.effort = std::max(ranges.effort, std::abs(one.smooth.effort[i]));
    }
    const double period =
        one.smooth.steady ? one.smooth.steady->period : m.time.back() - m.time.front();
    ranges.shortest_period = std::min(ranges.shortest_period, period);
  }
  ranges.motion = std::max(std::abs(ranges.lowest_motion), std::abs(ranges.highest_motion));
  return ranges;
}

}  // namespace flexspline::estimators
