#include "flexspline/core/torsion_record.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "flexspline/core/rig_residuals.hpp"

namespace flexspline {
namespace {

using Series = const std::vector<double>*;

tl::unexpected<Error> missing(const Recording& recording, Rig rig, std::string_view what) {
  return failure(ErrorCode::input_missing,
                 "recording " + recording.id + ": no " + std::string(what) +
                     ", which the torsion law needs on the " + std::string(name_of(rig)) + " rig",
                 "measure it and name it in dataset.toml");
}

/// The first of the quantities that the recording has.
std::optional<Quantity> first_of(const Recording& recording,
                                 std::initializer_list<Quantity> candidates) {
  for (const Quantity quantity : candidates) {
    if (recording.find(quantity) != nullptr) return quantity;
  }
  return std::nullopt;
}

Result<double> gear_ratio(const RecordingSet& set, const Recording& recording) {
  const auto found = set.constants.find("gear_ratio");
  if (found == set.constants.end()) return missing(recording, set.rig, "gear_ratio");
  return found->second;
}

/// theta_m / N, less theta_l where the load turns.
Result<void> add_drive_motion(const RecordingSet& set, const Recording& recording,
                              TorsionRecord& record) {
  const Series motor = recording.find(Quantity::motor_angle);
  if (motor == nullptr) return missing(recording, set.rig, "motor_angle");
  const Result<double> ratio = gear_ratio(set, recording);
  if (!ratio) return tl::unexpected<Error>(ratio.error());
  record.motion.reserve(motor->size());
  for (const double angle : *motor) record.motion.push_back(angle / *ratio);
  if (set.rig == Rig::locked) return {};
  const Series load = recording.find(Quantity::load_angle);
  if (load == nullptr) return missing(recording, set.rig, "load_angle");
  for (std::size_t i = 0; i < load->size(); ++i) record.motion[i] -= (*load)[i];
  return {};
}

Result<void> add_specimen_motion(const Recording& recording, TorsionRecord& record) {
  const auto quantity =
      first_of(recording, {Quantity::torsion, Quantity::displacement, Quantity::angle});
  if (!quantity) return missing(recording, Rig::specimen, "torsion, displacement or angle");
  record.motion = *recording.find(*quantity);
  record.travels = *quantity == Quantity::angle;
  record.linear = *quantity == Quantity::displacement;
  return {};
}

// Without a torque sensor what the load's inertia takes, J2 theta_l''.
Result<void> add_inertia_torque(double inertia, const Recording& recording, TorsionRecord& record) {
  auto channels = drive_channels(Rig::free, {}, recording);
  if (!channels) return tl::unexpected<Error>(channels.error());
  record.effort = std::move(channels->load_acceleration);
  for (double& torque : record.effort) torque *= inertia;
  return {};
}

Result<void> add_effort(const RecordingSet& set, const Recording& recording,
                        TorsionRecord& record) {
  if (has_torque_by_inertia(set)) {
    return add_inertia_torque(set.constants.at("load_inertia_kgm2"), recording, record);
  }
  const Rig rig = set.rig;
  const bool specimen = rig == Rig::specimen;
  const auto quantity =
      specimen
          ? first_of(recording, {Quantity::transmitted_torque, Quantity::torque, Quantity::force})
          : first_of(recording, {Quantity::transmitted_torque});
  if (!quantity) {
    return missing(recording, rig,
                   specimen ? "transmitted_torque, torque or force" : "transmitted_torque");
  }
  record.effort = *recording.find(*quantity);
  return {};
}

std::vector<bool> validity(const Recording& recording) {
  std::vector<bool> valid(recording.time.size(), true);
  const Series marks = recording.find(Quantity::valid);
  if (marks == nullptr) return valid;
  for (std::size_t i = 0; i < marks->size(); ++i) valid[i] = (*marks)[i] >= 0.5;
  return valid;
}

}  // namespace

bool has_torque_by_inertia(const RecordingSet& set) {
  const auto inertia = set.constants.find("load_inertia_kgm2");
  return set.rig == Rig::free && inertia != set.constants.end() && inertia->second > 0.0 &&
         std::ranges::none_of(set.recordings, [](const Recording& r) {
           return r.find(Quantity::transmitted_torque) != nullptr;
         });
}

Result<TorsionRecord> torsion_record(const RecordingSet& set, const Recording& recording) {
  if (set.rig == Rig::servo) {
    return failure(
        ErrorCode::input_missing,
        "recording " + recording.id + ": the servo rig measures no torque across the transmission",
        "use recordings of a locked, free or specimen rig");
  }
  TorsionRecord record;
  const Result<void> motion = set.rig == Rig::specimen ? add_specimen_motion(recording, record)
                                                       : add_drive_motion(set, recording, record);
  if (!motion) return tl::unexpected<Error>(motion.error());
  const Result<void> effort = add_effort(set, recording, record);
  if (!effort) return tl::unexpected<Error>(effort.error());
  record.id = recording.id;
  record.split = recording.split;
  // On the free rig the nominal amplitude is that of the load angle, not of the torsion.
  if (set.rig != Rig::free) record.amplitude = recording.amplitude;
  record.frequency_hz = recording.frequency_hz;
  record.time = recording.time;
  record.valid = validity(recording);
  return record;
}

Result<std::vector<TorsionRecord>> torsion_records(const RecordingSet& set) {
  std::vector<TorsionRecord> records;
  for (const Recording& recording : set.recordings) {
    Result<TorsionRecord> record = torsion_record(set, recording);
    if (!record) return tl::unexpected<Error>(in_context(std::move(record.error()), set.name));
    records.push_back(*std::move(record));
  }
  return records;
}

}  // namespace flexspline
