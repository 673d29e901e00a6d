#include "rigs/drive_model.hpp"

#include <algorithm>
#include <limits>
#include <numbers>
#include <tuple>

#include <fmt/format.h>

#include "flexspline/core/effect_dependence.hpp"
#include "flexspline/core/effect_path.hpp"
#include "rigs/drive_at.hpp"

namespace flexspline {
namespace {

using Dependence = NamedVariable;

// Known only after the equations are solved, or not at all.
constexpr Dependence kNeverKnown[] = {
    {&Instant<Complex>::motor_acceleration, "acceleration"},
    {&Instant<Complex>::load_acceleration, "acceleration"},
    {&Instant<Complex>::torsion_acceleration, "acceleration"},
    {&Instant<Complex>::transmitted_torque_rate, "rate of the transmitted torque"}};

// A position loop makes the motor torque; its rate is known after the equations are solved, which
// is early enough for a memory.
constexpr Dependence kUnknownInALoop = {&Instant<Complex>::motor_torque_rate,
                                        "rate of the motor torque"};

// The torsion is what kinematics make, so they cannot follow from it.
constexpr Dependence kUnknownToKinematics[] = {
    {&Instant<Complex>::torsion_rate, "rate of the torsion"},
    {&Instant<Complex>::motor_speed, "motor speed"},
    {&Instant<Complex>::load_speed, "load speed"}};

tl::unexpected<Error> refusal(const EffectRow& row, std::string_view needs) {
  return failure(
      ErrorCode::bad_data,
      fmt::format("the effect {} cannot be simulated forward: it needs the {}, which the "
                  "simulation does not know beforehand",
                  row.id, needs),
      "simulate displacement-driven, or take the effect out of the model");
}

// A recorded torque tells the rate of the true one, to the memory of its sensor.
bool sensor_remembers(const EffectRow& row, std::span<const double> values, const Dependence& one,
                      TorqueFrom torque) {
  return torque == TorqueFrom::recorded && row.site == Site::torque_signal &&
         one.member == &Instant<Complex>::transmitted_torque_rate &&
         !term_depends_on(row, values, one.member);
}

Result<void> check(const EffectRow& row, std::span<const double> values, TorqueFrom torque) {
  if (row.real.term == nullptr || row.map != nullptr) {
    return refusal(row, "whole signal");
  }
  if (row.states > 0 && row.real.rate == nullptr) return refusal(row, "path between samples");
  for (const Dependence& one : kNeverKnown) {
    if (sensor_remembers(row, values, one, torque)) continue;
    if (depends_on(row, values, one.member)) return refusal(row, one.name);
  }
  if (torque == TorqueFrom::loop && term_depends_on(row, values, kUnknownInALoop.member)) {
    return refusal(row, kUnknownInALoop.name);
  }
  if (row.site != Site::kinematics) return {};
  for (const Dependence& one : kUnknownToKinematics) {
    if (depends_on(row, values, one.member)) return refusal(row, one.name);
  }
  return {};
}

}  // namespace

Result<DriveModel> DriveModel::make(const DriveSpec& drive, std::vector<DriveConstant> constants,
                                    std::vector<Site> signals, TorqueFrom torque) {
  DriveModel model;
  model.drive_ = drive;
  model.constants_ = std::move(constants);
  const LawSpec* specs[] = {&drive.torsion.f, &drive.torsion.g_inverse, &drive.torsion.h};
  for (std::size_t k = 0; k < 3; ++k) {
    auto law = make_law(*specs[k]);
    if (!law) return tl::unexpected(law.error());
    model.laws_[k] = std::move(*law);
    model.law_starts_[k + 1] = model.law_starts_[k] + specs[k]->coefficients.size();
  }
  model.first_constant_ = model.law_starts_[3];
  model.parameters_ = model.first_constant_ + model.constants_.size();
  for (const EffectSpec& spec : drive.torsion.effects) {
    const auto row = find_effect(spec.effect);
    if (!row) return tl::unexpected(row.error());
    const auto values = parameter_values(**row, spec);
    if (!values) return tl::unexpected(values.error());
    const Site site = site_of(**row, spec);
    EffectUse use{*row, site, spec.across, model.parameters_, values->size(), model.memory_, 0};
    model.parameters_ += values->size();
    // What only the instruments show is entered afterwards.
    if (on_instrument(site) && std::ranges::find(signals, site) == signals.end()) {
      continue;
    }
    if (auto good = check(**row, *values, torque); !good) return tl::unexpected(good.error());
    use.follows_torsion = depends_on(**row, *values, &Instant<Complex>::torsion);
    use.follows_torque = depends_on(**row, *values, &Instant<Complex>::transmitted_torque);
    use.follows_motor =
        !spec.across && term_depends_on(**row, *values, &Instant<Complex>::motor_angle);
    use.follows_load =
        !spec.across && term_depends_on(**row, *values, &Instant<Complex>::load_angle);
    if (site == Site::kinematics) {
      const bool of_torque = term_depends_on(**row, *values, &Instant<Complex>::transmitted_torque);
      model.torsion_is_state_ |= of_torque;
      // A memory may need a threshold of torque to move, which no step finds.
      model.follows_torque_ |= of_torque || (*row)->states > 0;
    }
    use.states = state_count(**row, values->size());
    model.sensor_remembers_ |= site == Site::torque_signal && use.states > 0;
    model.memory_ += use.states;
    model.effects_.push_back(use);
  }
  return model;
}

Result<void> DriveModel::check_yielding() const {
  if (!torsion_is_state_) return {};
  std::vector<Complex> p;
  for (const auto& one : parameters_of(drive_, constants_)) p.emplace_back(one.value);
  const std::vector<Complex> memory(memory_, Complex(0.0));
  const DriveAt<Complex> at(*this, p, memory);
  constexpr double kStep = 1e-30;
  double stiffest = -std::numeric_limits<double>::infinity();
  double where = 0.0;
  for (double angle = 0.0; angle < 2.0 * std::numbers::pi * 50.0; angle += 0.05) {
    Instant<Complex> x;
    x.gear_ratio = Complex(drive_.gear_ratio);
    x.motor_angle = Complex(angle);
    x.transmitted_torque = Complex(0.0, kStep);
    const double slope = at.kinematics(x).imag() / kStep;
    if (slope > stiffest) std::tie(stiffest, where) = std::pair(slope, angle);
  }
  if (stiffest <= 0.0) return {};
  return failure(ErrorCode::bad_data,
                 fmt::format("at motor angle {:.3g} rad the torsion grows by {:.3g} rad/Nm under "
                             "load: a negative compliance in series with the torsion law, which "
                             "leaves its rate without a stable root",
                             where, stiffest),
                 fmt::format("add a series_compliance of {:.3g} rad/Nm or more, simulate "
                             "displacement-driven, or take the effect out of the model",
                             stiffest));
}

bool DriveModel::has(Site site) const {
  return std::ranges::any_of(effects_, [&](const EffectUse& use) { return use.site == site; });
}

void DriveModel::remake(std::size_t which, std::vector<double> coefficients) const {
  LawSpec spec = laws_[which]->spec();
  spec.coefficients = std::move(coefficients);
  auto law = make_law(spec);
  expects(law.has_value(), "the coefficients of a law stay within what it takes");
  laws_[which] = std::move(*law);
}

}  // namespace flexspline
