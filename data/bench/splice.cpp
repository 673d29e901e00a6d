#include "flexspline/data/splice.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "bench/hidden_differences.hpp"
#include "bench/hidden_law.hpp"
#include "bench/local_parabola.hpp"

namespace flexspline::data {
namespace {

constexpr double kSizeTolerance = 0.02;
constexpr int kMostTrials = 30;

const Quantity* find_of(const Recording& recording, std::span<const Quantity> among) {
  const auto found = std::ranges::find_if(
      among, [&](Quantity quantity) { return recording.find(quantity) != nullptr; });
  return found == among.end() ? nullptr : &*found;
}

constexpr Quantity kEfforts[] = {Quantity::transmitted_torque, Quantity::torque, Quantity::force};
constexpr Quantity kMotions[] = {Quantity::torsion, Quantity::angle, Quantity::displacement};

/// One recording as the bench's laws see it.
struct Track {
  std::vector<Jet> motion;
  HiddenSignals signals;
  std::vector<bool> valid;
};

Track track_of(const Recording& recording, double ratio) {
  Track track;
  const std::vector<double>& motion = *recording.find(*find_of(recording, kMotions));
  track.motion = local_parabolas(recording.time, motion);
  HiddenSignals& s = track.signals;
  s.start_s = recording.start_s;
  s.step = (recording.time.back() - recording.time.front()) /
           static_cast<double>(recording.time.size() - 1);
  s.torque = *recording.find(*find_of(recording, kEfforts));
  s.load_angle.assign(motion.size(), 0.0);
  s.motor_torque = s.load_angle;
  for (const double value : motion) s.motor_angle.push_back(ratio * value);
  const std::vector<double>* valid = recording.find(Quantity::valid);
  for (std::size_t k = 0; k < motion.size(); ++k) {
    track.valid.push_back(valid == nullptr || (*valid)[k] != 0.0);
  }
  return track;
}

template <class Value>
double peak_of(const Track& track, const Value& value) {
  double peak = 0.0;
  for (std::size_t k = 0; k < track.valid.size(); ++k) {
    if (track.valid[k]) peak = std::max(peak, std::abs(value(k)));
  }
  return peak;
}

/// What the laws scale themselves by, from the recordings.
HiddenScale scale_of(const RecordingSet& set, const std::vector<Track>& tracks,
                     const HiddenGear& gear, std::uint64_t seed) {
  HiddenScale scale;
  scale.rig = set.rig;
  scale.travels = kind_of(set).travels;
  scale.gear = &gear;
  scale.seed = seed;
  double sum = 0.0;
  for (std::size_t r = 0; r < tracks.size(); ++r) {
    const Track& track = tracks[r];
    const auto jet = [&](double Jet::*part) {
      return peak_of(track, [&](std::size_t k) { return track.motion[k].*part; });
    };
    const double speed = jet(&Jet::first);
    const double motion = jet(&Jet::value);
    const std::vector<double> rate = slopes(track.signals.torque, track.signals.step);
    scale.motion = std::max(scale.motion, motion);
    scale.speed = std::max(scale.speed, speed);
    scale.acceleration = std::max(scale.acceleration, jet(&Jet::second));
    scale.torque = std::max(scale.torque,
                            peak_of(track, [&](std::size_t k) { return track.signals.torque[k]; }));
    scale.torque_rate =
        std::max(scale.torque_rate, peak_of(track, [&](std::size_t k) { return rate[k]; }));
    const double duration = track.signals.step * static_cast<double>(track.motion.size());
    scale.recordings.push_back({set.recordings[r].id, track.signals.start_s, duration});
    scale.clock_end = std::max(scale.clock_end, track.signals.start_s + duration);
    sum += std::log(speed / motion);
  }
  std::ranges::sort(scale.recordings, {}, &HiddenScale::Span::id);
  scale.torsion = scale.motion;
  scale.mean_rate = std::exp(sum / static_cast<double>(tracks.size()));
  return scale;
}

/// What a law adds to the torque of one recording; laws with a memory begin anew.
std::vector<double> additions(HiddenLaw law, const Track& track) {
  HiddenSignals s = track.signals;
  for (std::size_t k = 0; k < s.size(); ++k) {
    const Jet& x = track.motion[k];
    if (law.load) s.torque[k] += law.load({x.value, x.first, x.second, s.clock(k)});
    const double since = x.value - track.motion.front().value;
    const TorsionPoint point{since, k == 0 ? 0.0 : s.step, s.motor_angle[k], x.first, s.clock(k)};
    if (law.transmission) s.torque[k] += law.transmission(point);
    if (law.remember) law.remember(point);
  }
  if (law.sensing) law.sensing(s);
  for (std::size_t k = 0; k < s.size(); ++k) {
    s.torque[k] = track.valid[k] ? s.torque[k] - track.signals.torque[k] : 0.0;
  }
  return std::move(s.torque);
}

double largest(const std::vector<std::vector<double>>& added) {
  double most = 0.0;
  for (const auto& series : added) {
    for (const double value : series) most = std::max(most, std::abs(value));
  }
  return most;
}

/// A gear without laws: what is spliced may not ask for any.
HiddenGear ratio_alone(const RecordingSet& set) {
  HiddenGear gear;
  const auto ratio = set.constants.find("gear_ratio");
  gear.gear_ratio = kind_of(set).travels && ratio != set.constants.end() ? ratio->second : 1.0;
  return gear;
}

bool acts_on_torque(const HiddenRow& row) {
  const bool at_torque = row.site == HiddenSite::transmission || row.site == HiddenSite::load ||
                         row.site == HiddenSite::motor || row.site == HiddenSite::torque_sensor;
  if (!at_torque || row.make == nullptr) return false;
  HiddenGear gear;
  HiddenScale one;
  one.rig = Rig::specimen;
  one.gear = &gear;
  one.torque = one.torque_rate = one.motion = one.speed = one.acceleration = one.torsion = 1.0;
  one.mean_rate = one.clock_end = 1.0;
  return !row.make(one, 0.01).windup;
}

}  // namespace

BenchKind kind_of(const RecordingSet& set) {
  const bool travels = std::ranges::any_of(set.recordings, [](const Recording& recording) {
    return recording.find(Quantity::angle) != nullptr;
  });
  return {set.rig, set.rig == Rig::specimen && travels};
}

std::vector<std::string> spliceable(const RecordingSet& set) {
  std::vector<std::string> ids;
  const bool has_torque = std::ranges::all_of(set.recordings, [](const Recording& recording) {
    return find_of(recording, kEfforts) != nullptr && find_of(recording, kMotions) != nullptr;
  });
  if (set.rig != Rig::specimen || !has_torque) return ids;
  for (const HiddenRow& row : hidden_effects()) {
    if (hidden_class(row.id) != HiddenClass::named || !row.shows_on(kind_of(set))) continue;
    if (acts_on_torque(row)) ids.emplace_back(row.id);
  }
  return ids;
}

Result<SplicedSet> splice(const RecordingSet& set, const HiddenEffect& effect, std::uint64_t seed) {
  const std::vector<std::string> ids = spliceable(set);
  if (std::ranges::find(ids, effect.id) == ids.end()) {
    return failure(ErrorCode::usage,
                   fmt::format("effect '{}' cannot be spliced into '{}'", effect.id, set.name),
                   fmt::format("choose one of {}", fmt::join(ids, ", ")));
  }
  const HiddenRow& row = **find_hidden_effect(effect.id);
  const HiddenGear gear = ratio_alone(set);
  std::vector<Track> tracks;
  for (const Recording& recording : set.recordings) {
    tracks.push_back(track_of(recording, gear.gear_ratio));
  }
  const HiddenScale scale = scale_of(set, tracks, gear, seed);
  double amount = effect.size_fraction;
  for (int trial = 0; trial < kMostTrials; ++trial) {
    std::vector<std::vector<double>> added;
    for (const Track& track : tracks) added.push_back(additions(row.make(scale, amount), track));
    const double share = largest(added) / scale.torque;
    if (!std::isfinite(share) || share == 0.0) break;
    if (std::abs(share / effect.size_fraction - 1.0) > kSizeTolerance) {
      amount *= std::clamp(effect.size_fraction / share, 0.1, 10.0);
      continue;
    }
    SplicedSet spliced{set, {}, scale.torque};
    for (std::size_t r = 0; r < tracks.size(); ++r) {
      Recording& recording = spliced.set.recordings[r];
      std::vector<double>& torque = recording.channels.at(*find_of(recording, kEfforts));
      for (std::size_t k = 0; k < torque.size(); ++k) torque[k] += added[r][k];
    }
    HiddenLaw law = row.make(scale, amount);
    spliced.finding = {effect.id, std::string(row.coordinate), HiddenEquation::torsion, share,
                       std::move(law.parameters)};
    return spliced;
  }
  return failure(ErrorCode::usage,
                 fmt::format("effect '{}' does not come to {} of the peak torque of '{}'",
                             effect.id, effect.size_fraction, set.name),
                 "ask for another size or another effect");
}

}  // namespace flexspline::data
