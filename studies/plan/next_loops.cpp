#include "flexspline/studies/next_loops.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "flexspline/core/estimate.hpp"
#include "flexspline/core/signals.hpp"
#include "flexspline/core/simulate.hpp"
#include "flexspline/core/torsion_record.hpp"
#include "flexspline/estimators/method.hpp"

namespace flexspline::studies {
namespace {

constexpr double kAmplitudes[] = {0.25, 0.5, 0.75, 1.0};
constexpr double kRates[] = {0.125, 0.25, 0.5, 1.0};
constexpr double kSame = 0.1;   // of amplitude and of rate: recorded already
constexpr double kInner = 0.8;  // of the band's domain, beyond which it opens
constexpr int kCycles = 3;
constexpr int kSamples = 200;  // a cycle
constexpr std::uint64_t kSeed = 1;

using estimators::FitProblem;

double span(const std::vector<double>& values) {
  const auto [low, high] = std::ranges::minmax(values);
  return 0.5 * (high - low);
}

/// Of a recording: half range of the torsion, and its largest rate by that of a sine.
struct Reach {
  double amplitude = 0.0;
  double rate = 0.0;
};

Reach reach_of(const TorsionRecord& record) {
  Reach reach{span(record.motion), 0.0};
  for (std::size_t i = 4; i < record.time.size(); i += 4) {
    const double rate =
        std::abs(record.motion[i] - record.motion[i - 4]) / (record.time[i] - record.time[i - 4]);
    reach.rate = std::max(reach.rate, rate);
  }
  return reach;
}

bool alike(double a, double b) { return std::abs(a - b) < kSame * std::max(a, b); }

Result<std::vector<TorsionRecord>> records_of(const RecordingSet& set) {
  if (set.rig == Rig::free || set.rig == Rig::servo) {
    return failure(ErrorCode::bad_data, "the torsion of this rig follows from its load",
                   "loops of torsion are planned for locked rigs and wound specimens");
  }
  auto records = torsion_records(set);
  if (!records) return records;
  for (TorsionRecord& one : *records) {
    if (one.travels) {
      return failure(ErrorCode::bad_data, "a joint that travels has no loop of torsion",
                     "loops of torsion are planned for locked rigs and wound specimens");
    }
    one.split = Split::train;
  }
  return records;
}

double mean_half_width(const Estimate& estimate) {
  double sum = 0.0;
  double count = 0.0;
  for (const FunctionBand& band : estimate.bands) {
    if (band.function != "h") continue;
    for (std::size_t k = 0; k < band.argument.size(); ++k) {
      if (std::abs(band.argument[k]) > kInner * band.valid_to || !(band.lower[k] > 0.0)) continue;
      sum += 0.5 * std::log(band.upper[k] / band.lower[k]);
      count += 1.0;
    }
  }
  return count > 0.0 ? sum / count : kNotComputed;
}

Result<Estimate> fit(const std::vector<TorsionRecord>& records) {
  const auto method = estimators::find_method("static_regression");
  if (!method) return tl::unexpected(method.error());
  return (*method)->fit({records, {}});
}

LoopProspect prospect_of(const Estimate& estimate, double amplitude, double frequency) {
  const std::string& verdict = estimate.identifiability.verdict;
  return {amplitude, frequency, verdict == "identifiable" || verdict == "weak",
          mean_half_width(estimate)};
}

/// The recorded motions with the torque of the fit.
Result<std::vector<TorsionRecord>> simulated(std::vector<TorsionRecord> records,
                                             const ModelSpec& model) {
  for (TorsionRecord& one : records) {
    const auto smooth = reconstruct(one);
    if (!smooth) return tl::unexpected(in_context(smooth.error(), one.id));
    auto torque = simulate_torque(model, smooth->motion);
    if (!torque) return tl::unexpected(in_context(torque.error(), one.id));
    one.effort = std::move(*torque);
  }
  return records;
}

/// Rms of what the fit leaves, in the torque's unit.
double residual_of(const std::vector<TorsionRecord>& recorded,
                   const std::vector<TorsionRecord>& simulated) {
  double squares = 0.0;
  double count = 0.0;
  for (std::size_t r = 0; r < recorded.size(); ++r) {
    for (std::size_t i = 0; i < recorded[r].effort.size(); ++i) {
      squares += std::pow(simulated[r].effort[i] - recorded[r].effort[i], 2);
      count += 1.0;
    }
  }
  return std::sqrt(squares / count);
}

void add_noise(std::vector<TorsionRecord>& records, double noise) {
  std::mt19937_64 random(kSeed);
  std::normal_distribution<double> normal(0.0, noise);
  for (TorsionRecord& one : records) {
    for (double& torque : one.effort) torque += normal(random);
  }
}

Result<TorsionRecord> loop(const ModelSpec& model, double amplitude, double frequency,
                           bool linear) {
  Motion motion;
  const double w = 2.0 * std::numbers::pi * frequency;
  for (int i = 0; i <= kCycles * kSamples; ++i) {
    const double t = i / (frequency * kSamples);
    motion.time.push_back(t);
    motion.position.push_back(amplitude * std::sin(w * t));
    motion.velocity.push_back(amplitude * w * std::cos(w * t));
    motion.acceleration.push_back(-w * w * motion.position.back());
  }
  auto torque = simulate_torque(model, motion);
  if (!torque) return tl::unexpected(torque.error());
  TorsionRecord record{.id = "candidate",
                       .split = Split::train,
                       .amplitude = amplitude,
                       .frequency_hz = frequency,
                       .time = motion.time,
                       .motion = motion.position,
                       .effort = std::move(*torque),
                       .valid = {}};
  record.valid.assign(record.time.size(), true);
  record.linear = linear;
  return record;
}

struct Candidate {
  double amplitude = 0.0;
  double frequency = 0.0;
};

std::vector<Candidate> candidates_beside(const std::vector<TorsionRecord>& records) {
  std::vector<Reach> recorded;
  Reach most;
  for (const TorsionRecord& one : records) {
    recorded.push_back(reach_of(one));
    most.amplitude = std::max(most.amplitude, recorded.back().amplitude);
    most.rate = std::max(most.rate, recorded.back().rate);
  }
  std::vector<Candidate> list;
  for (const double a : kAmplitudes) {
    for (const double r : kRates) {
      const double amplitude = a * most.amplitude;
      const double rate = r * most.rate;
      const bool there = std::ranges::any_of(recorded, [&](const Reach& one) {
        return alike(one.amplitude, amplitude) && alike(one.rate, rate);
      });
      if (!there) list.push_back({amplitude, rate / (2.0 * std::numbers::pi * amplitude)});
    }
  }
  return list;
}

bool more_telling(const LoopProspect& a, const LoopProspect& b) {
  if (a.tells_h != b.tells_h) return a.tells_h;
  if (std::isnan(a.h_half_width) || std::isnan(b.h_half_width)) {
    return !std::isnan(a.h_half_width) && std::isnan(b.h_half_width);
  }
  return a.h_half_width < b.h_half_width;
}

}  // namespace

Result<LoopPlan> plan_loops(const RecordingSet& set, const std::function<void(double)>& progress) {
  const auto records = records_of(set);
  if (!records) return tl::unexpected(records.error());
  const auto known = fit(*records);
  if (!known) return tl::unexpected(known.error());
  const auto likely = simulated(*records, known->model);
  if (!likely) return tl::unexpected(likely.error());
  const double noise = residual_of(*records, *likely);
  const auto prospect = [&](std::vector<TorsionRecord> all, double amplitude,
                            double frequency) -> Result<LoopProspect> {
    add_noise(all, noise);
    return fit(all).map([&](const Estimate& e) { return prospect_of(e, amplitude, frequency); });
  };
  const auto as_recorded = prospect(*likely, 0.0, 0.0);
  if (!as_recorded) return tl::unexpected(as_recorded.error());
  LoopPlan plan{*as_recorded, known->identifiability.says, noise, {}};
  const auto candidates = candidates_beside(*records);
  for (const Candidate& one : candidates) {
    if (progress) {
      progress((1.0 + static_cast<double>(plan.candidates.size())) /
               (1.0 + static_cast<double>(candidates.size())));
    }
    auto added = loop(known->model, one.amplitude, one.frequency, records->front().linear);
    if (!added) return tl::unexpected(added.error());
    auto all = *likely;
    all.push_back(std::move(*added));
    const auto with = prospect(std::move(all), one.amplitude, one.frequency);
    if (!with) return tl::unexpected(in_context(with.error(), "with one loop more"));
    plan.candidates.push_back(*with);
  }
  std::ranges::stable_sort(plan.candidates, more_telling);
  return plan;
}

}  // namespace flexspline::studies
