#include "diagnosis/model/cause_columns.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Values = std::span<const double>;

std::vector<Shape> knee(const Frame& f) {
  return {{.name = "knee",
           .unit = "rad",
           .lower = 0.03 * f.torsion_range,
           .upper = 0.7 * f.torsion_range,
           .grid = 4,
           .meaning = "torsion at which it stiffens"}};
}

Columns stiffening(Equation, const Frame& f, const Reference&, Values shape) {
  return {f.torsion - shape[0] * (f.torsion / shape[0]).tanh()};
}

// A spring that is held firm cannot be soft at first.
bool may_be_soft(const Frame& f) { return wound_up(f) && !f.firm_spring; }

Counterpart as_windup(const FittedCause& c) {
  return {.effects = {{"soft_windup", {{"stiffening", c.coefficients[0]}, {"knee", c.shape[0]}}}}};
}

std::vector<Term> terms(const Frame&) {
  return {{"stiffening", "Nm/rad", "by which the stiffness grows from the middle to the ends"}};
}

}  // namespace

CauseRow describe_soft_windup() {
  return {.id = "soft_windup",
          .coordinate = "torsion",
          .forms = {{.equation = "tau += (K3 - K1) (phi - p tanh(phi/p))",
                     .rigs = kAnyRig,
                     .at = {Equation::torsion},
                     .shapes = knee,
                     .terms = terms,
                     .columns = stiffening,
                     .nonnegative = true,
                     .where = may_be_soft,
                     .counterpart = as_windup}}};
}

}  // namespace flexspline::studies
