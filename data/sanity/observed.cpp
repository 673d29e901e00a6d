#include "sanity/observed.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "flexspline/core/in_parallel.hpp"
#include "flexspline/core/rig_residuals.hpp"

namespace flexspline::data {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Series = std::vector<double>;

constexpr std::size_t kMostSamples = 4000;
constexpr std::size_t kLeastSamples = 16;
constexpr Index kEnd = 4;  // a smoothing spline's rates are loose at its ends

bool moves(const Series& values) { return range_of(values) > 0.0; }

/// Every n-th sample of the channels that are told apart from a constant.
Recording thinned(const Recording& recording) {
  const std::size_t stride = (recording.time.size() + kMostSamples - 1) / kMostSamples;
  const auto take = [&](const Series& from) {
    Series to;
    for (std::size_t i = 0; i < from.size(); i += stride) to.push_back(from[i]);
    return to;
  };
  Recording view;
  view.id = recording.id;
  view.time = take(recording.time);
  for (const auto& [quantity, values] : recording.channels) {
    if (moves(values)) view.channels[quantity] = take(values);
  }
  return view;
}

ArrayXd array(const Series& values) {
  return Eigen::Map<const ArrayXd>(values.data(), static_cast<Index>(values.size()));
}

ArrayXd usable_of(const Recording& view) {
  ArrayXd usable = ArrayXd::Ones(static_cast<Index>(view.time.size()));
  for (const Quantity mark : {Quantity::valid, Quantity::drive_enabled}) {
    if (const Series* marks = view.find(mark)) usable *= (array(*marks) > 0.5).cast<double>();
  }
  usable.head(kEnd).setZero(), usable.tail(kEnd).setZero();
  return usable;
}

ArrayXd drive_of(const Recording& view, const Recording& whole) {
  for (const Quantity direct : {Quantity::motor_torque, Quantity::current}) {
    if (const Series* found = view.find(direct)) return array(*found);
  }
  const Series* duty = view.find(Quantity::duty_cycle);
  if (duty == nullptr) return {};
  if (const Series* supply = view.find(Quantity::supply_voltage)) {
    return array(*duty) * array(*supply);
  }
  const Series* constant = whole.find(Quantity::supply_voltage);
  return array(*duty) * (constant == nullptr ? 1.0 : constant->front());
}

void take_motion(const ObservedSet& all, const DriveChannels& c, Observed& o) {
  if (all.set.rig == Rig::specimen) {
    o.motion = array(c.torsion), o.rate = array(c.torsion_rate);
    return;
  }
  const double ratio = all.constant("gear_ratio");
  if (!(std::abs(ratio) > 0.0) || o.motor_angle.size() == 0) return;
  if (all.set.rig == Rig::free && o.load_angle.size() == 0) return;
  o.motion = o.motor_angle / ratio, o.rate = o.motor_speed / ratio;
  if (o.load_angle.size() == 0) return;
  o.motion -= o.load_angle, o.rate -= o.load_speed;
}

Observed observed(const ObservedSet& all, const Recording& recording) {
  Observed o;
  o.recording = &recording;
  if (recording.time.size() < kLeastSamples) return o;
  const Recording view = thinned(recording);
  o.time = array(view.time);
  o.usable = usable_of(view);
  const auto channels = drive_channels(all.set.rig, {}, view);
  if (!channels) return o;
  o.motor_angle = array(channels->motor_angle), o.motor_speed = array(channels->motor_speed);
  o.motor_acceleration = array(channels->motor_acceleration);
  o.load_angle = array(channels->load_angle), o.load_speed = array(channels->load_speed);
  o.load_acceleration = array(channels->load_acceleration);
  o.effort = array(channels->transmitted_torque);
  o.drive = drive_of(view, recording);
  take_motion(all, *channels, o);
  if (const auto* held = held_motion(all.set, view)) {
    o.sine = fit_sine(view.time, *held, std::nullopt);
  }
  return o;
}

}  // namespace

double ObservedSet::constant(std::string_view key) const {
  const auto found = set.constants.find(std::string(key));
  return found == set.constants.end() ? std::numeric_limits<double>::quiet_NaN() : found->second;
}

bool ObservedSet::travels() const {
  return std::ranges::any_of(set.recordings, [](const Recording& recording) {
    return recording.find(Quantity::angle) != nullptr;
  });
}

std::vector<Quantity> telling_channels(const RecordingSet& set) {
  using enum Quantity;
  switch (set.rig) {
    case Rig::locked:
      return {motor_angle, transmitted_torque, motor_torque};
    case Rig::free:
      return {motor_angle, load_angle, transmitted_torque, motor_torque};
    case Rig::specimen:
      return {torsion, angle, displacement, transmitted_torque, torque, force};
    case Rig::servo:
      break;
  }
  return {load_angle, motor_torque, current, duty_cycle};
}

std::vector<Quantity> sensed_channels(const RecordingSet& set) {
  std::vector<Quantity> list = telling_channels(set);
  std::erase(list, Quantity::duty_cycle);
  return list;
}

bool is_position(Quantity quantity) {
  using enum Quantity;
  return quantity == motor_angle || quantity == load_angle || quantity == angle ||
         quantity == torsion || quantity == displacement;
}

Recording without_marked(const Recording& recording) {
  const Series* valid = recording.find(Quantity::valid);
  Recording sound = recording;
  if (valid == nullptr) return sound;
  const auto keep_valid = [&](Series& values) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      if ((*valid)[i] > 0.5) values[kept++] = values[i];
    }
    values.resize(kept);
  };
  keep_valid(sound.time);
  for (auto& [quantity, values] : sound.channels) keep_valid(values);
  return sound;
}

const std::vector<double>* held_motion(const RecordingSet& set, const Recording& recording) {
  using enum Quantity;
  if (set.rig == Rig::locked) return recording.find(motor_angle);
  if (set.rig != Rig::specimen) return recording.find(load_angle);
  for (const Quantity quantity : {torsion, angle, displacement}) {
    if (const auto* found = recording.find(quantity)) return found;
  }
  return nullptr;
}

double range_of(std::span<const double> values) {
  const auto [low, high] = std::ranges::minmax_element(values);
  return values.empty() ? 0.0 : *high - *low;
}

double range_of(const ArrayXd& values) {
  return values.size() == 0 ? 0.0 : values.maxCoeff() - values.minCoeff();
}

double median_of(std::vector<double> values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

ObservedSet observe(const RecordingSet& set) {
  ObservedSet all{set, {}};
  std::vector<Observed> each(set.recordings.size());
  in_parallel(each.size(), 0, [&](std::size_t i) { each[i] = observed(all, set.recordings[i]); });
  all.recordings = std::move(each);
  return all;
}

}  // namespace flexspline::data
