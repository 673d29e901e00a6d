#include "rigs/drive_model.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace flexspline {
namespace {

struct Dependence {
  Complex Instant<Complex>::*member;
  std::string_view name;
};

// Known only after the equations are solved, or not at all.
constexpr Dependence kNeverKnown[] = {
    {&Instant<Complex>::motor_acceleration, "acceleration"},
    {&Instant<Complex>::load_acceleration, "acceleration"},
    {&Instant<Complex>::torsion_acceleration, "acceleration"},
    {&Instant<Complex>::transmitted_torque_rate, "rate of the transmitted torque"}};

// The torsion is what kinematics make, so they cannot follow from it.
constexpr Dependence kUnknownToKinematics[] = {
    {&Instant<Complex>::torsion_rate, "rate of the torsion"},
    {&Instant<Complex>::transmitted_torque, "transmitted torque"},
    {&Instant<Complex>::motor_speed, "motor speed"},
    {&Instant<Complex>::load_speed, "load speed"}};

// By complex steps at an instant where nothing is zero.
bool depends(const EffectRow& row, std::span<const double> values, const Dependence& on) {
  Instant<Complex> x;
  double next = 0.37;
  for (auto member :
       {&Instant<Complex>::time, &Instant<Complex>::motor_angle, &Instant<Complex>::motor_speed,
        &Instant<Complex>::motor_acceleration, &Instant<Complex>::load_angle,
        &Instant<Complex>::load_speed, &Instant<Complex>::load_acceleration,
        &Instant<Complex>::torsion_rate, &Instant<Complex>::torsion_acceleration,
        &Instant<Complex>::transmitted_torque, &Instant<Complex>::transmitted_torque_rate,
        &Instant<Complex>::motor_torque, &Instant<Complex>::motor_torque_rate}) {
    x.*member = Complex(next += 0.23);
  }
  x.torsion = 1e-3;
  x.*on.member += Complex(0.0, 1e-20);
  const std::vector<Complex> p(values.begin(), values.end());
  const std::vector<Complex> memory(state_count(row, p.size()), Complex(1e-4));
  return row.complex.term(x, p, memory).imag() != 0.0;
}

tl::unexpected<Error> refusal(const EffectRow& row, std::string_view needs) {
  return failure(
      ErrorCode::bad_data,
      fmt::format("the effect {} cannot be simulated forward: it needs the {}, which the "
                  "simulation does not know beforehand",
                  row.id, needs),
      "simulate displacement-driven, or take the effect out of the model");
}

Result<void> check(const EffectRow& row, std::span<const double> values) {
  if (row.real.term == nullptr || row.map != nullptr) {
    return refusal(row, "whole signal");
  }
  if (row.states > 0 && row.real.rate == nullptr) return refusal(row, "path between samples");
  for (const Dependence& one : kNeverKnown) {
    if (depends(row, values, one)) return refusal(row, one.name);
  }
  if (row.site != Site::kinematics) return {};
  for (const Dependence& one : kUnknownToKinematics) {
    if (depends(row, values, one)) return refusal(row, one.name);
  }
  return {};
}

}  // namespace

Result<DriveModel> DriveModel::make(const DriveSpec& drive, std::vector<DriveConstant> constants,
                                    std::vector<Site> signals) {
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
    EffectUse use{*row, model.parameters_, values->size(), model.memory_, 0};
    model.parameters_ += values->size();
    // What only the instruments show is entered afterwards.
    if (on_instrument((*row)->site) && std::ranges::find(signals, (*row)->site) == signals.end()) {
      continue;
    }
    if (auto good = check(**row, *values); !good) return tl::unexpected(good.error());
    use.follows_torsion = depends(**row, *values, {&Instant<Complex>::torsion, "torsion"});
    use.states = state_count(**row, values->size());
    model.memory_ += use.states;
    model.effects_.push_back(use);
  }
  return model;
}

bool DriveModel::has(Site site) const {
  return std::ranges::any_of(effects_, [&](const EffectUse& use) { return use.row->site == site; });
}

void DriveModel::remake(std::size_t which, std::vector<double> coefficients) const {
  LawSpec spec = laws_[which]->spec();
  spec.coefficients = std::move(coefficients);
  auto law = make_law(spec);
  expects(law.has_value(), "the coefficients of a law stay within what it takes");
  laws_[which] = std::move(*law);
}

}  // namespace flexspline
