#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "flexspline/core/remembered.hpp"
#include "flexspline/core/signals.hpp"
#include "signals/smoothing.hpp"

namespace flexspline {
namespace {

constexpr std::size_t kFewest = 16;  // samples of a spline
constexpr double kFollows = 0.01;    // of the motion's rms: harmonics that leave less follow it
constexpr double kNoisy = 3.0;       // noises of neighbouring samples: what noise may leave
constexpr std::size_t kRememberedBytes = std::size_t{32} << 20U;

double smoothstep(double u) {
  u = std::clamp(u, 0.0, 1.0);
  return u * u * (3.0 - 2.0 * u);
}

struct Segment {
  std::size_t first;
  std::size_t last;
};

using Signals = std::vector<SmoothSignal>;

Signals splines_over(const TorsionRecord& record, Segment segment) {
  const std::size_t length = segment.last - segment.first;
  const auto part = [&](std::span<const double> whole) {
    return whole.subspan(segment.first, length);
  };
  const std::span<const double> signals[] = {part(record.motion), part(record.effort)};
  auto smooth = smooth_by_splines(part(record.time), signals);
  expects(smooth.has_value(), "reconstruct has checked the samples");
  return *std::move(smooth);
}

// A motion is differentiated and has few harmonics; an effort has kinks, which must not be rounded.
Signals harmonics_over(const TorsionRecord& record, const SteadyPart& steady) {
  const auto part = [&](std::span<const double> whole) {
    return whole.subspan(steady.first, steady.last - steady.first);
  };
  const Sampled signals[] = {{part(record.motion), Harmonics::significant},
                             {part(record.effort), Harmonics::all}};
  return smooth_by_harmonics(part(record.time), signals, steady.period);
}

double rms(std::span<const double> values, double about) {
  double sum = 0.0;
  for (const double x : values) sum += (x - about) * (x - about);
  return std::sqrt(sum / static_cast<double>(values.size()));
}

// By third differences, in which a smooth motion has no share.
double noise_of_neighbours(std::span<const double> y) {
  std::vector<double> third;
  for (std::size_t i = 3; i < y.size(); ++i)
    third.push_back(y[i] - 3.0 * y[i - 1] + 3.0 * y[i - 2] - y[i - 3]);
  return rms(third, 0.0) / std::sqrt(20.0);
}

// Whether one cycle may stand for all: cycles of a steady part agree within 15 %, and where they
// differ by more than noise a memory of reversals needs each as it was.
bool one_cycle_serves(const TorsionRecord& record, const SteadyPart& steady,
                      const SmoothSignal& motion) {
  const auto part =
      std::span<const double>(record.motion).subspan(steady.first, steady.last - steady.first);
  const double mean =
      std::accumulate(part.begin(), part.end(), 0.0) / static_cast<double>(part.size());
  return motion.noise <= kFollows * rms(part, mean) ||
         motion.noise <= kNoisy * noise_of_neighbours(part);
}

// Adds a part of the record to the whole with a weight for every instant.
template <class Weight>
void add(Signals& whole, const Signals& part, std::size_t offset, const Weight& weight) {
  for (std::size_t s = 0; s < whole.size(); ++s) {
    for (std::size_t j = 0; j < part[s].value.size(); ++j) {
      const double w = weight(offset + j);
      whole[s].value[offset + j] += w * part[s].value[j];
      whole[s].rate[offset + j] += w * part[s].rate[j];
      whole[s].second[offset + j] += w * part[s].second[j];
      whole[s].error[offset + j] += w * part[s].error[j];
    }
  }
}

// Motion and effort: the steady part by its harmonics where they follow it, what is before and
// after by splines; they meet over a quarter of a cycle inside the steady part.
Signals smooth(const TorsionRecord& record, const std::optional<SteadyPart>& steady) {
  const std::vector<double>& time = record.time;
  const std::size_t n = time.size();
  if (!steady) return splines_over(record, {0, n});
  const Signals periodic = harmonics_over(record, *steady);
  if (!one_cycle_serves(record, *steady, periodic[0])) return splines_over(record, {0, n});
  const double begins = time[steady->first];
  const double ends = time[steady->last - 1];
  const double overlap = 0.25 * steady->period;
  const bool before = steady->first > 0;
  const bool after = steady->last < n;
  auto weight = [&](std::size_t i) {
    const double rise = before ? smoothstep((time[i] - begins) / overlap) : 1.0;
    const double fall = after ? smoothstep((ends - time[i]) / overlap) : 1.0;
    return std::min(rise, fall);
  };
  const std::vector<double> zero(n, 0.0);
  Signals whole;
  for (const SmoothSignal& signal : periodic)
    whole.push_back({zero, zero, zero, signal.noise, zero});
  add(whole, periodic, steady->first, weight);
  const auto reaches = [&](double t) {
    return static_cast<std::size_t>(std::lower_bound(time.begin(), time.end(), t) - time.begin());
  };
  if (before) {
    const std::size_t last = std::clamp(reaches(begins + 2.0 * overlap), std::min(n, kFewest), n);
    add(whole, splines_over(record, {0, last}), 0,
        [&](std::size_t i) { return time[i] < begins + overlap ? 1.0 - weight(i) : 0.0; });
  }
  if (after) {
    const std::size_t first = std::min(reaches(ends - 2.0 * overlap), n - std::min(n, kFewest));
    add(whole, splines_over(record, {first, n}), first,
        [&](std::size_t i) { return time[i] > ends - overlap ? 1.0 - weight(i) : 0.0; });
  }
  return whole;
}

Reconstruction reconstruct_moving(const TorsionRecord& record) {
  Reconstruction result;
  result.steady = find_steady_part(record);
  Signals signals = smooth(record, result.steady);
  SmoothSignal& motion = signals[0];
  SmoothSignal& effort = signals[1];
  result.motion = {.time = record.time,
                   .position = std::move(motion.value),
                   .velocity = std::move(motion.rate),
                   .acceleration = std::move(motion.second)};
  result.motion_noise = motion.noise;
  result.motion_error = std::move(motion.error);
  result.effort = std::move(effort.value);
  result.effort_noise = effort.noise;
  return result;
}

}  // namespace

Result<Reconstruction> reconstruct(const TorsionRecord& record) {
  const std::span<const double> signals[] = {record.motion, record.effort};
  if (auto sound = check_samples(record.time, signals); !sound) {
    return tl::unexpected(in_context(sound.error(), "recording " + record.id));
  }
  const auto [low, high] = std::ranges::minmax(record.motion);
  if (!(high > low)) {
    return failure(ErrorCode::numerics, fmt::format("recording {} does not move", record.id),
                   "leave it out, or check the channel of its motion");
  }
  // Every estimator and every comparison of a study asks for the same records again.
  static Remembered<Reconstruction> remembered(kRememberedBytes);
  return *remembered.of(content_of(record), [&] { return reconstruct_moving(record); });
}

}  // namespace flexspline
