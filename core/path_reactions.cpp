#include "path_reactions.hpp"

#include "flexspline/core/effect_dependence.hpp"
#include "flexspline/core/effect_path.hpp"

namespace flexspline {
namespace {

using Path = std::vector<Instant<double>>;
using Member = double Instant<double>::*;

// d term/d angle along a path, by sixth-order differences.
Result<std::vector<double>> slopes_along(const EffectRow& row, const EffectSpec& spec,
                                         const Path& path, Member angle) {
  const double step = angle == &Instant<double>::motor_angle ? 1e-3 : 1e-4;
  std::vector<double> slope(path.size(), 0.0);
  constexpr double kWeights[] = {3.0 / 4.0, -3.0 / 20.0, 1.0 / 60.0};
  for (int k = -3; k <= 3; ++k) {
    if (k == 0) continue;
    Path moved = path;
    for (auto& x : moved) x.*angle += k * step;
    const auto terms = terms_along(row, spec, moved);
    if (!terms) return terms;
    const double weight = (k > 0 ? kWeights[k - 1] : -kWeights[-k - 1]) / step;
    for (std::size_t i = 0; i < slope.size(); ++i) slope[i] += weight * (*terms)[i];
  }
  return slope;
}

bool follows(const EffectRow& row, std::span<const double> values, Member angle) {
  return term_depends_on(row, values,
                         angle == &Instant<double>::motor_angle ? &Instant<Complex>::motor_angle
                                                                : &Instant<Complex>::load_angle);
}

}  // namespace

Result<std::vector<double>> reactions_along(const ModelSpec& model,
                                            std::span<const Instant<double>> rigid,
                                            std::span<const Instant<double>> seen, Member angle) {
  std::vector<double> sum(rigid.size(), 0.0);
  for (const EffectSpec& spec : model.effects) {
    const auto row = find_effect(spec.effect);
    if (!row) return tl::unexpected(row.error());
    const bool kinematic = (*row)->site == Site::kinematics;
    if (!kinematic && (*row)->site != Site::transmission) continue;
    const auto values = parameter_values(**row, spec);
    if (!values) return tl::unexpected(values.error());
    if (!follows(**row, *values, angle)) continue;
    const auto whole = kinematic ? rigid : seen;
    const Member over =
        kinematic ? &Instant<double>::transmitted_torque : &Instant<double>::torsion;
    Path half(whole.begin(), whole.end());
    for (auto& x : half) x.*over *= 0.5;
    const auto slope = slopes_along(**row, spec, half, angle);
    if (!slope) return slope;
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += whole[i].*over * (*slope)[i];
  }
  return sum;
}

}  // namespace flexspline
