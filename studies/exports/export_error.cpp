#include "flexspline/studies/export_error.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "flexspline/core/law.hpp"
#include "flexspline/core/simulate.hpp"
#include "flexspline/core/simulate_rig.hpp"

namespace flexspline::studies {
namespace {

using Series = std::vector<double>;

constexpr double kSeconds = 10.0;
constexpr int kSamples = 5000;
constexpr double kShare = 0.7;  // of what f is valid to

double domain_of(const LawSpec& law) { return law.valid_to > 0.0 ? law.valid_to : law.scale; }

/// Three sines of these share, 0.3, 0.71 and 1.3 Hz; at most 1.
double wave(double t) {
  const double w = 2.0 * std::numbers::pi * t;
  return 0.5 * std::sin(0.3 * w) + 0.3 * std::sin(0.71 * w) + 0.2 * std::sin(1.3 * w);
}

/// Torque at the motor that winds the gear up so far, through what the motor keeps to itself.
Result<double> motor_amplitude(const RigModel& model) {
  const DriveSpec& d = model.drive;
  const auto f = make_law(d.torsion.f);
  if (!f) return tl::unexpected(f.error());
  double torque = kShare * (*f)->value(domain_of(d.torsion.f));
  const double weight = d.load_mass * d.gravity * d.arm_length;
  if (model.rig == Rig::servo) torque = weight > 0.0 ? 0.7 * weight : 5.0 * d.load_inertia;
  const double own = d.load_inertia > 0.0 ? reflected_inertia(d) / d.load_inertia : 0.0;
  double friction = d.motor_coulomb;
  for (const EffectSpec& one : d.torsion.effects) {
    if (one.effect == "coulomb_viscous_friction") friction += one.parameters.front().second;
  }
  return torque * (1.0 + own) / d.gear_ratio + 2.0 * friction;
}

Recording excitation(double amplitude) {
  Recording recording;
  recording.id = "excitation";
  for (int i = 0; i <= kSamples; ++i) {
    const double t = kSeconds * i / kSamples;
    recording.time.push_back(t);
    recording.channels[Quantity::motor_torque].push_back(amplitude * wave(t));
  }
  return recording;
}

Motion motion_over(const ModelSpec& model) {
  Motion motion;
  const double amplitude = kShare * domain_of(model.f);
  const double speed = domain_of(model.g_inverse) / (6.0 * amplitude);
  for (int i = 0; i <= kSamples; ++i) {
    const double t = kSeconds * i / kSamples;
    const double step = 1e-3;
    const auto at = [&](double s) { return amplitude * wave(speed * s); };
    motion.time.push_back(t);
    motion.position.push_back(at(t));
    motion.velocity.push_back((at(t + step) - at(t - step)) / (2.0 * step));
    motion.acceleration.push_back((at(t + step) - 2.0 * at(t) + at(t - step)) / (step * step));
  }
  return motion;
}

ExportError compared(std::string output, const Series& whole, const Series& exported) {
  const auto [low, high] = std::ranges::minmax(whole);
  const double half = 0.5 * (high - low);
  ExportError error{std::move(output), 0.0, 0.0};
  for (std::size_t i = 0; i < whole.size(); ++i) {
    const double off = std::abs(exported[i] - whole[i]) / half;
    error.rms += off * off / static_cast<double>(whole.size());
    error.largest = std::max(error.largest, off);
  }
  error.rms = std::sqrt(error.rms);
  return error;
}

Result<ExportError> specimen_error(const ModelSpec& model, const ModelSpec& exported) {
  const Motion motion = motion_over(model);
  const auto whole = simulate_torque(model, motion);
  if (!whole) return tl::unexpected(whole.error());
  const auto other = simulate_torque(exported, motion);
  if (!other) return tl::unexpected(other.error());
  return compared("torque", *whole, *other);
}

double rms_between(const Series& a, const Series& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return sum;
}

/// Adds squares of errors of one recording; the number of samples.
Result<double> add_squares(const RigModel& model, const Recording& one, Quantity torque,
                           double& squares) {
  const auto predicted = torques_along(model, one);
  if (!predicted) return tl::unexpected(in_context(predicted.error(), one.id));
  const Series* measured = one.find(torque);
  const Series* simulated = predicted->find(torque);
  if (measured == nullptr || simulated == nullptr) return 0.0;
  squares += rms_between(*measured, *simulated);
  return static_cast<double>(measured->size());
}

}  // namespace

Result<ExportError> export_error(const RigModel& model, const RigModel& exported) {
  if (model.rig == Rig::specimen) {
    return specimen_error(model.drive.torsion, exported.drive.torsion);
  }
  const auto amplitude = motor_amplitude(model);
  if (!amplitude) return tl::unexpected(amplitude.error());
  const Recording recording = excitation(*amplitude);
  const auto whole = motions_under(model, recording);
  if (!whole) return tl::unexpected(in_context(whole.error(), "the model"));
  const auto other = motions_under(exported, recording);
  if (!other) return tl::unexpected(in_context(other.error(), "the exported form"));
  const Quantity shown = model.rig == Rig::locked ? Quantity::motor_angle : Quantity::load_angle;
  return compared(std::string(name_of(shown)), *whole->find(shown), *other->find(shown));
}

Result<std::vector<HeldOutError>> held_out_errors(const RigModel& model, const RigModel& exported,
                                                  const RecordingSet& set) {
  if (set.rig != model.rig || model.rig == Rig::specimen) {
    return failure(ErrorCode::bad_data,
                   fmt::format("the model is of the {} rig, the data set of the {} rig",
                               name_of(model.rig), name_of(set.rig)),
                   "give recordings of the model's own rig");
  }
  const auto is_out = [](const Recording& r) { return r.split == Split::holdout; };
  const bool marked = std::ranges::any_of(set.recordings, is_out);
  std::vector<HeldOutError> errors;
  for (Quantity torque : {Quantity::transmitted_torque, Quantity::motor_torque}) {
    HeldOutError error{torque, 0.0, 0.0};
    double count = 0.0;
    for (const Recording& one : set.recordings) {
      if (marked && !is_out(one)) continue;
      const auto samples = add_squares(model, one, torque, error.model);
      if (!samples) return tl::unexpected(samples.error());
      if (auto other = add_squares(exported, one, torque, error.exported); !other) {
        return tl::unexpected(other.error());
      }
      count += *samples;
    }
    if (count == 0.0) continue;
    error.model = std::sqrt(error.model / count);
    error.exported = std::sqrt(error.exported / count);
    errors.push_back(error);
  }
  return errors;
}

}  // namespace flexspline::studies
