#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "flexspline/core/effect.hpp"
#include "flexspline/core/signals.hpp"
#include "flexspline/core/simulate.hpp"
#include "flexspline/core/simulate_rig.hpp"
#include "flexspline/core/torsion_record.hpp"
#include "flexspline/estimators/rig_fit.hpp"

namespace flexspline::estimators {
namespace {

using Series = std::vector<double>;

constexpr double kTrifle = 0.002;  // rms over the largest torque
constexpr double kLeft = 0.2;      // of the smaller of two parts

/// Every torque that a model gives along the recordings, one after another.
using Torques = std::map<Quantity, Series>;

void append(const Recording& from, Torques& to) {
  for (Quantity one : {Quantity::transmitted_torque, Quantity::motor_torque}) {
    if (const Series* torque = from.find(one)) {
      to[one].insert(to[one].end(), torque->begin(), torque->end());
    }
  }
}

Result<void> add_specimen(const RigModel& model, const RecordingSet& set, const Recording& one,
                          Torques& torques) {
  const auto record = torsion_record(set, one);
  if (!record) return tl::unexpected(record.error());
  const auto smooth = reconstruct(*record);
  if (!smooth) return tl::unexpected(smooth.error());
  const auto torque = simulate_torque(model.drive.torsion, smooth->motion);
  if (!torque) return tl::unexpected(torque.error());
  Series& all = torques[Quantity::transmitted_torque];
  all.insert(all.end(), torque->begin(), torque->end());
  return {};
}

Result<Torques> torques_of(const RigModel& model, const RecordingSet& set) {
  Torques torques;
  for (const Recording& one : set.recordings) {
    if (model.rig == Rig::specimen) {
      if (auto done = add_specimen(model, set, one, torques); !done) {
        return tl::unexpected(in_context(done.error(), one.id));
      }
      continue;
    }
    const auto simulated = torques_along(model, one);
    if (!simulated) return tl::unexpected(in_context(simulated.error(), one.id));
    append(*simulated, torques);
  }
  return torques;
}

double rms(const Series& x) {
  double sum = 0.0;
  for (double v : x) sum += v * v;
  return std::sqrt(sum / static_cast<double>(std::max<std::size_t>(x.size(), 1)));
}

double largest(const Series& x) {
  double most = 0.0;
  for (double v : x) most = std::max(most, std::abs(v));
  return most;
}

RigModel without(RigModel model, const std::set<std::size_t>& effects) {
  auto& all = model.drive.torsion.effects;
  for (auto at = effects.rbegin(); at != effects.rend(); ++at) {
    all.erase(all.begin() + static_cast<long>(*at));
  }
  return model;
}

/// What an effect adds to each torque.
Result<Torques> part_of(const RigModel& model, const RecordingSet& set, const Torques& whole,
                        std::size_t effect) {
  auto part = torques_of(without(model, {effect}), set);
  if (!part) return part;
  for (auto& [quantity, series] : *part) {
    const Series& all = whole.at(quantity);
    for (std::size_t i = 0; i < series.size(); ++i) series[i] = all[i] - series[i];
  }
  return part;
}

double share_of(const Torques& part, const Torques& whole) {
  double most = 0.0;
  for (const auto& [quantity, series] : part) {
    const double range = largest(whole.at(quantity));
    if (range > 0.0) most = std::max(most, rms(series) / range);
  }
  return most;
}

/// Rms of the sum over that of the smaller part, where both have one.
double left_of(const Series& a, const Series& b) {
  Series sum(a.size());
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] = a[i] + b[i];
  const double smaller = std::min(rms(a), rms(b));
  return smaller > 0.0 ? rms(sum) / smaller : 1.0;
}

class Judge {
 public:
  Judge(RigModel model, std::vector<Torques> parts) : parts_(std::move(parts)) {
    result_.model = std::move(model);
  }

  Corrections judged(const Torques& whole) {
    mark_trifles(whole);
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      for (std::size_t k = i + 1; k < parts_.size(); ++k) refuse_cancelling(i, k);
    }
    result_.model = without(std::move(result_.model), refused_);
    return std::move(result_);
  }

 private:
  const std::string& name(std::size_t i) const {
    return result_.model.drive.torsion.effects[i].effect;
  }

  void mark_trifles(const Torques& whole) {
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      const double share = share_of(parts_[i], whole);
      if (share >= kTrifle) continue;
      const std::string note =
          fmt::format("too small to be named: {:.2g} % of torque (rms)", 100.0 * share);
      result_.model.drive.torsion.effects[i].note = note;
      result_.notes.push_back(fmt::format("model.toml holds {}: {}", name(i), note));
    }
  }

  void refuse_cancelling(std::size_t i, std::size_t k) {
    for (const auto& [quantity, series] : parts_[i]) {
      const double left = left_of(series, parts_[k].at(quantity));
      if (!(left < kLeft)) continue;
      refused_.insert({i, k});
      result_.notes.push_back(fmt::format(
          "model.toml lacks {} and {}: in the {} they nearly cancel, their sum is {:.0f} % of the "
          "smaller one, so that these recordings identify the sum and neither of the two",
          name(i), name(k), name_of(quantity), 100.0 * left));
      return;
    }
  }

  std::vector<Torques> parts_;
  Corrections result_;
  std::set<std::size_t> refused_;
};

}  // namespace

Result<Corrections> judge_corrections(const RecordingSet& set, RigModel model) {
  const auto whole = torques_of(model, set);
  if (!whole) return tl::unexpected(whole.error());
  std::vector<Torques> parts;
  for (std::size_t i = 0; i < model.drive.torsion.effects.size(); ++i) {
    auto part = part_of(model, set, *whole, i);
    if (!part) return tl::unexpected(part.error());
    parts.push_back(std::move(*part));
  }
  return Judge(std::move(model), std::move(parts)).judged(*whole);
}

}  // namespace flexspline::estimators
