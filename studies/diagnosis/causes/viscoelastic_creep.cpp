#include <cmath>

#include "diagnosis/model/cause_columns.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Values = std::span<const double>;

constexpr int kBranches = 7;

ArrayXd branch(const Frame& f, double relaxation) {
  ArrayXd column(f.rows());
  for (const Segment& s : f.segments) {
    double state = column[s.first] = 0.0;
    for (Eigen::Index r = s.first + 1; r < s.first + s.count; ++r) {
      const double dt = f.time[r] - f.time[r - 1];
      const double kept = std::exp(-dt / relaxation);
      const double rate = (f.torsion[r] - f.torsion[r - 1]) / dt;
      state = state * kept + relaxation * (1.0 - kept) * rate;
      column[r] = state;
    }
  }
  return column;
}

std::vector<double> relaxations_of(const Frame& f) {
  return geometric(4.0 * f.interval, f.duration, kBranches);
}

std::vector<Shape> relaxation(const Frame& f) {
  return {{.name = "time_constant",
           .unit = "s",
           .lower = 4.0 * f.interval,
           .upper = f.duration,
           .grid = kBranches,
           .meaning = "in which it relaxes"}};
}

Columns one_branch(Equation, const Frame& f, const Reference&, Values shape) {
  return {branch(f, shape[0])};
}

Columns branches(Equation, const Frame& f, const Reference&, Values) {
  Columns columns;
  for (double relaxation : relaxations_of(f)) {
    columns.push_back(branch(f, relaxation));
  }
  return columns;
}

Counterpart as_one_branch(const FittedCause& c) {
  return {.effects = {{"viscoelastic_creep",
                       {{"stiffness", c.coefficients[0]}, {"time_constant", c.shape[0]}}}}};
}

Counterpart as_branches(const FittedCause& c) {
  EffectSpec effect{"viscoelastic_creep", {}};
  const auto relaxations = relaxations_of(c.frame);
  for (std::size_t k = 0; k < relaxations.size(); ++k) {
    const double stiffness = c.coefficients[static_cast<Eigen::Index>(k)];
    if (!(stiffness > 0.0)) continue;
    effect.parameters.emplace_back("stiffness", stiffness);
    effect.parameters.emplace_back("time_constant", relaxations[k]);
  }
  if (effect.parameters.empty()) return {};
  return {.effects = {std::move(effect)}};
}

std::vector<Term> one_term(const Frame&) {
  return {{"stiffness", "Nm/rad", "of a spring that relaxes"}};
}

std::vector<Term> terms(const Frame& f) {
  return elements(relaxations_of(f),
                  {"stiffness", "Nm/rad", "of a spring that relaxes", "time_constant", 0.0, "s",
                   "in which it relaxes; of a fixed grid"});
}

}  // namespace

CauseRow describe_viscoelastic_creep() {
  return {.id = "viscoelastic_creep",
          .coordinate = "lag",
          .forms = {{.equation = "tau += k s, s' = phi' - s/T",
                     .rigs = kAnyRig,
                     .at = {Equation::torsion},
                     .shapes = relaxation,
                     .terms = one_term,
                     .columns = one_branch,
                     .nonnegative = true,
                     .where = wound_up,
                     .counterpart = as_one_branch},
                    {.equation = "tau += sum_i k_i s_i, s_i' = phi' - s_i/T_i",
                     .rigs = kAnyRig,
                     .at = {Equation::torsion},
                     .terms = terms,
                     .columns = branches,
                     .nonnegative = true,
                     .where = wound_up,
                     .counterpart = as_branches}}};
}

}  // namespace flexspline::studies
