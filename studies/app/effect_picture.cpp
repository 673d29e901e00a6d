#include "effect_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "flexspline/core/simulate_rig.hpp"

namespace flexspline::app {
namespace {

using reports::Figure;
using reports::Panel;

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kFrequency = 0.25;
constexpr double kTorsion = 0.2 * kDegree;
constexpr double kTravel = 30.0 * kDegree;
constexpr double kSeconds = 2.0 / kFrequency;
constexpr int kSamples = 1600;
constexpr int kEvery = 4;          // samples to one point of the picture
constexpr double kVisible = 1e-4;  // change of a channel, of its peak
constexpr std::array kCompared = {Quantity::transmitted_torque, Quantity::motor_torque,
                                  Quantity::load_angle, Quantity::motor_angle};

LawSpec polynomial(double scale, std::vector<double> coefficients) {
  return {"odd_polynomial", scale, {}, std::move(coefficients), scale};
}

RigModel unit_on(Rig rig) {
  RigModel model{rig, {}};
  DriveSpec& drive = model.drive;
  drive.torsion.f = polynomial(4e-3, {120.0, 40.0});
  drive.torsion.g_inverse = polynomial(0.02, {6.0, 1.0});
  drive.torsion.h.law = "bounded_modulation";
  drive.torsion.h.scale = 4e-3;
  drive.gear_ratio = rig == Rig::specimen ? 1.0 : 50.0;
  if (rig == Rig::specimen) return model;
  drive.motor_inertia = 7.26e-4;
  drive.motor_viscous = 6e-4;
  drive.motor_coulomb = 0.06;
  drive.coulomb_width = 0.5;
  drive.load_inertia = rig == Rig::locked ? 0.0 : 2.0;
  return model;
}

EffectSpec nominal(const EffectRow& row) {
  EffectSpec effect{std::string(row.id), {}};
  for (const EffectParameter& one : row.parameters) {
    effect.parameters.emplace_back(std::string(one.name) + (row.repeats ? "_1" : ""), one.nominal);
  }
  return effect;
}

/// Two cycles of 0.25 Hz, torsion of 0.2 deg; where the output turns, 30 deg of it.
Recording motion_on(Rig rig, double ratio) {
  Recording motion;
  motion.id = "sine";
  const bool travels = rig == Rig::free || rig == Rig::servo;
  for (int i = 0; i <= kSamples; ++i) {
    const double t = kSeconds * i / kSamples;
    const double phase = 2.0 * std::numbers::pi * kFrequency * t;
    const double torsion = rig == Rig::servo ? 0.0 : kTorsion * std::sin(phase);
    const double load = travels ? kTravel * std::sin(phase - 0.5) : 0.0;
    motion.time.push_back(t);
    if (rig == Rig::specimen) {
      motion.channels[Quantity::torsion].push_back(torsion);
      continue;
    }
    motion.channels[Quantity::motor_angle].push_back(ratio * (load + torsion));
    if (travels) motion.channels[Quantity::load_angle].push_back(load);
  }
  return motion;
}

/// A specimen has no shafts: its torque is that of eq. (4).
Result<Recording> simulated(const RigModel& model, const Recording& motion) {
  if (model.rig != Rig::specimen) return torques_along(model, motion);
  const std::vector<double>& torsion = *motion.find(Quantity::torsion);
  const double omega = 2.0 * std::numbers::pi * kFrequency;
  Motion given{motion.time, torsion, {}, {}};
  for (std::size_t i = 0; i < torsion.size(); ++i) {
    given.velocity.push_back(omega * kTorsion * std::cos(omega * motion.time[i]));
    given.acceleration.push_back(-omega * omega * torsion[i]);
  }
  auto torque = simulate_torque(model.drive.torsion, given);
  if (!torque) return tl::unexpected(torque.error());
  Recording recording = motion;
  recording.channels[Quantity::transmitted_torque] = std::move(*torque);
  return recording;
}

/// Without and with an effect, and the channel that it changes most, of that channel's peak.
struct Comparison {
  Rig rig = Rig::free;
  Recording without, with;
  Quantity changed = Quantity::transmitted_torque;
  double change = 0.0;
};

void find_change(Comparison& both) {
  for (const Quantity quantity : kCompared) {
    const auto* before = both.without.find(quantity);
    const auto* after = both.with.find(quantity);
    if (before == nullptr || after == nullptr) continue;
    double change = 0.0, peak = 1e-300;
    for (std::size_t i = 0; i < before->size(); ++i) {
      change = std::max(change, std::abs((*after)[i] - (*before)[i]));
      peak = std::max(peak, std::abs((*before)[i]));
    }
    if (change / peak <= both.change) continue;
    both.changed = quantity;
    both.change = change / peak;
  }
}

/// A motor torque from which the free rig moves by some tens of degrees.
Recording torque_on_motor() {
  Recording drive;
  drive.id = "sine";
  for (int i = 0; i <= kSamples; ++i) {
    const double t = kSeconds * i / kSamples;
    drive.time.push_back(t);
    drive.channels[Quantity::motor_torque].push_back(
        0.5 * std::sin(2.0 * std::numbers::pi * kFrequency * t));
  }
  return drive;
}

Result<Comparison> compared(const EffectRow& row, Rig rig, bool along_motion) {
  RigModel model = unit_on(rig);
  const Recording input = along_motion ? motion_on(rig, model.drive.gear_ratio) : torque_on_motor();
  const auto run = [&] {
    return along_motion ? simulated(model, input) : motions_under(model, input);
  };
  auto without = run();
  if (!without) return tl::unexpected(without.error());
  model.drive.torsion.effects.push_back(nominal(row));
  auto with = run();
  if (!with) return tl::unexpected(with.error());
  Comparison both{rig, std::move(*without), std::move(*with)};
  find_change(both);
  return both;
}

/// The first of these that shows the effect: a load, a lag or an encoder is not seen in every
/// torque.
Result<Comparison> shown(const EffectRow& row) {
  constexpr std::array kTries = {std::pair(Rig::free, true), std::pair(Rig::locked, true),
                                 std::pair(Rig::servo, true), std::pair(Rig::specimen, true),
                                 std::pair(Rig::free, false)};
  Result<Comparison> best = Comparison();
  for (const auto& [rig, along_motion] : kTries) {
    if (std::ranges::find(row.rigs, rig) == row.rigs.end()) continue;
    auto one = compared(row, rig, along_motion);
    if (!one || one->change > kVisible) return one;
    if (one->change >= best->change) best = std::move(one);
  }
  return best;
}

std::string words_of(Quantity quantity) {
  std::string name(name_of(quantity));
  std::ranges::replace(name, '_', ' ');
  return name;
}

std::vector<double> thinned(const std::vector<double>& values, double unit) {
  std::vector<double> points;
  for (std::size_t i = 0; i < values.size(); i += kEvery) points.push_back(values[i] / unit);
  return points;
}

std::vector<double> torsion_of(const Recording& recording, double ratio) {
  if (const auto* torsion = recording.find(Quantity::torsion)) return *torsion;
  std::vector<double> torsion = *recording.find(Quantity::motor_angle);
  const auto* load = recording.find(Quantity::load_angle);
  for (std::size_t i = 0; i < torsion.size(); ++i) {
    torsion[i] = torsion[i] / ratio - (load != nullptr ? (*load)[i] : 0.0);
  }
  return torsion;
}

Panel panel_over(const std::string& title, const std::string& over, const std::string& of) {
  Panel panel;
  panel.title = title;
  panel.x.label = over;
  panel.y.label = of;
  return panel;
}

Figure drawn(const EffectRow& row, const Comparison& both) {
  const bool is_angle =
      both.changed == Quantity::load_angle || both.changed == Quantity::motor_angle;
  const double unit = is_angle ? kDegree : 1.0;
  const std::string of = words_of(both.changed) + (is_angle ? " / deg" : " / Nm");
  const bool over_torsion = both.changed == Quantity::transmitted_torque;
  const auto time = thinned(both.without.time, 1.0);
  const double ratio = unit_on(both.rig).drive.gear_ratio;
  const auto x_of = [&](const Recording& one) {
    if (is_angle) return time;
    return thinned(over_torsion ? torsion_of(one, ratio) : *one.find(Quantity::motor_angle),
                   kDegree);
  };
  const auto before = thinned(*both.without.find(both.changed), unit);
  const auto after = thinned(*both.with.find(both.changed), unit);
  Panel loop = panel_over("without and with it",
                          is_angle       ? "time / s"
                          : over_torsion ? "torsion / deg"
                                         : "motor angle / deg",
                          of);
  loop.series.push_back({"without", "line", {"measured", 0}, x_of(both.without), before, {}, {}});
  loop.series.push_back({"with", "line", {"estimator", 1}, x_of(both.with), after, {}, {}});
  std::vector<double> difference(before.size());
  for (std::size_t i = 0; i < before.size(); ++i) difference[i] = after[i] - before[i];
  Panel signature = panel_over("signature: with minus without", "time / s", of);
  signature.series.push_back({"with", "line", {"estimator", 1}, time, difference, {}, {}});
  Figure figure;
  figure.id = row.id;
  figure.title = fmt::format("{} on the {} rig", row.id, name_of(both.rig));
  figure.frames.push_back({{}, {std::move(loop), std::move(signature)}});
  return figure;
}

}  // namespace

Result<Figure> picture_of(const EffectRow& row) {
  const auto both = shown(row);
  if (!both) return tl::unexpected(both.error());
  return drawn(row, *both);
}

}  // namespace flexspline::app
