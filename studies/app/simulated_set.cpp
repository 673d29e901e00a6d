#include "simulated_set.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "flexspline/core/model_domain.hpp"
#include "flexspline/core/simulate.hpp"
#include "flexspline/core/simulate_rig.hpp"
#include "flexspline/core/torsion_record.hpp"

namespace flexspline::app {
namespace {

Result<Recording> simulate_one(const ModelSpec& model, const Excitation& excitation,
                               Direction direction, bool linear) {
  Recording recording;
  recording.id = excitation.id;
  recording.split = excitation.split;
  recording.excitation = "simulated";
  recording.amplitude = excitation.amplitude;
  recording.frequency_hz = excitation.frequency_hz;
  recording.time = excitation.motion.time;
  Result<std::vector<double>> simulated =
      direction == Direction::torque
          ? simulate_torque(model, excitation.motion)
          : simulate_torsion(model, excitation.motion.time, excitation.effort,
                             excitation.motion.position.front());
  if (!simulated)
    return tl::unexpected(in_context(simulated.error(), "recording " + excitation.id));
  const bool forward = direction == Direction::torque;
  recording.channels[linear ? Quantity::displacement : Quantity::torsion] =
      forward ? excitation.motion.position : *simulated;
  recording.channels[linear ? Quantity::force : Quantity::torque] =
      forward ? *simulated : excitation.effort;
  return recording;
}

/// Central differences, one-sided at the ends.
double rate_at(const std::vector<double>& time, const std::vector<double>& motion, std::size_t i) {
  const std::size_t from = i > 0 ? i - 1 : 0;
  const std::size_t to = std::min(i + 1, motion.size() - 1);
  return (motion[to] - motion[from]) / (time[to] - time[from]);
}

constexpr double kFar = 1.1;  // of a range

/// How much of the model's ranges is used, over all samples.
struct Reach {
  double of_f = 0.0;
  double of_g_inverse = 0.0;
  std::size_t outside = 0;
  std::size_t samples = 0;
};

void add(const ModelDomain& domain, const TorsionRecord& recording, Reach& reach) {
  const std::vector<double>& motion = recording.motion;
  for (std::size_t i = 0; i < motion.size(); ++i) {
    const double rate = rate_at(recording.time, motion, i);
    reach.of_f = std::max(reach.of_f, domain.share_of_f(motion[i]));
    reach.of_g_inverse = std::max(reach.of_g_inverse, domain.share_of_g_inverse(motion[i], rate));
    if (!domain.holds_at(motion[i], rate)) ++reach.outside;
  }
  reach.samples += motion.size();
}

}  // namespace

Result<Extrapolation> extrapolation(const ModelSpec& model, const RecordingSet& simulated) {
  if (simulated.rig == Rig::servo) return Extrapolation();  // nothing of it shows the torsion
  const auto domain = ModelDomain::of(model);
  if (!domain) return tl::unexpected(domain.error());
  const auto records = torsion_records(simulated);
  if (!records) return tl::unexpected(records.error());
  Reach reach;
  for (const TorsionRecord& record : *records) add(*domain, record, reach);
  Extrapolation result;
  if (!domain->is_known()) {
    result.says =
        "the model does not say how far recordings support it (valid_to of f or g^-1 is missing): "
        "whether this is extrapolated cannot be told";
  }
  if (100 * reach.outside <= reach.samples) return result;
  result.far = std::max(reach.of_f, reach.of_g_inverse) > kFar;
  result.says = fmt::format(
      "extrapolated: the motion goes to {:.3g} times the range of f and the rate to {:.3g} times "
      "the range of g^-1 that recordings support; {:.0f} % of the samples lie outside",
      reach.of_f, reach.of_g_inverse,
      100.0 * static_cast<double>(reach.outside) / static_cast<double>(reach.samples));
  return result;
}

Excitation sine_excitation(double amplitude, double frequency_hz, long cycles, long samples,
                           Direction direction) {
  Excitation excitation;
  excitation.id = "sine";
  excitation.frequency_hz = frequency_hz;
  const double omega = 2.0 * std::numbers::pi * frequency_hz;
  const bool moves = direction == Direction::torque;
  if (moves) excitation.amplitude = amplitude;
  for (long i = 0; i <= cycles * samples; ++i) {
    const double t = static_cast<double>(i) / (frequency_hz * static_cast<double>(samples));
    excitation.motion.time.push_back(t);
    excitation.motion.position.push_back(moves ? amplitude * std::sin(omega * t) : 0.0);
    excitation.motion.velocity.push_back(moves ? amplitude * omega * std::cos(omega * t) : 0.0);
    excitation.motion.acceleration.push_back(-omega * omega * excitation.motion.position.back());
    excitation.effort.push_back(amplitude * std::sin(omega * t));
  }
  return excitation;
}

Result<std::vector<Excitation>> excitations_like(const RecordingSet& set) {
  const auto records = torsion_records(set);
  if (!records) return tl::unexpected(records.error());
  std::vector<Excitation> excitations;
  for (const TorsionRecord& record : *records) {
    auto smooth = reconstruct(record);
    if (!smooth) return tl::unexpected(in_context(smooth.error(), "recording " + record.id));
    excitations.push_back({record.id, record.split, record.amplitude, record.frequency_hz,
                           std::move(smooth->motion), std::move(smooth->effort)});
  }
  return excitations;
}

Result<RecordingSet> simulate_rig_set(const RigModel& model, const RecordingSet& like,
                                      Direction direction) {
  if (like.rig != model.rig) {
    return failure(ErrorCode::bad_data,
                   fmt::format("the model is of the {} rig, the data set of the {} rig",
                               name_of(model.rig), name_of(like.rig)),
                   "simulate it like a data set of its own rig");
  }
  RecordingSet set = like;
  set.name = "simulated";
  set.license = "CC0-1.0";
  set.source = "flexspline simulate";
  for (Recording& one : set.recordings) {
    auto simulated =
        direction == Direction::torque ? torques_along(model, one) : motions_under(model, one);
    if (!simulated) return tl::unexpected(in_context(simulated.error(), "recording " + one.id));
    for (auto& [quantity, channel] : simulated->channels) one.channels[quantity] = channel;
    one.excitation = "simulated";
  }
  return set;
}

Result<RecordingSet> simulate_set(const ModelSpec& model,
                                  const std::vector<Excitation>& excitations, Direction direction,
                                  const DisplayUnits& units) {
  RecordingSet set;
  set.name = "simulated";
  set.rig = Rig::specimen;
  set.license = "CC0-1.0";
  set.source = "flexspline simulate";
  set.display = units;
  const auto unit = find_unit(units.motion);
  const bool linear = unit && unit->dimension == Dimension::length;
  for (const Excitation& excitation : excitations) {
    auto recording = simulate_one(model, excitation, direction, linear);
    if (!recording) return tl::unexpected(recording.error());
    set.recordings.push_back(std::move(*recording));
  }
  return set;
}

}  // namespace flexspline::app
