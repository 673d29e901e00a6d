#include "diagnosis/model/cause_columns.hpp"

namespace flexspline::studies {
namespace {

using Values = std::span<const double>;

// A share that goes by the rate of now: what relaxes goes by those before, too.
Columns stiffer_in_motion(Equation, const Frame& f, const Reference& reference, Values shape) {
  const Eigen::ArrayXd ratio = (f.torsion_rate / shape[0]).square();
  return {reference.elastic * ratio / (1.0 + ratio)};
}

std::vector<Shape> half_rate(const Frame& f) {
  return {{.name = "half_rate",
           .unit = "rad/s",
           .lower = 1e-3 * f.rate_range,
           .upper = f.rate_range,
           .meaning = "at which half of it is there"}};
}

std::vector<Term> terms(const Frame&) {
  return {{"share", "1", "of the spring's torque, where the rate is large"}};
}

}  // namespace

CauseRow describe_rate_dependent_stiffness() {
  return {.id = "rate_dependent_stiffness",
          .coordinate = "velocity",
          .forms = {{.equation = "tau += a f(phi) phi'^2/(phi'^2 + v^2)",
                     .rigs = kAnyRig,
                     .at = {Equation::torsion},
                     .shapes = half_rate,
                     .terms = terms,
                     .columns = stiffer_in_motion,
                     .where = wound_up,
                     .no_counterpart = "the catalogue of effects has no spring of the rate"}},
          .outside = "a spring whose stiffness goes by the rate"};
}

}  // namespace flexspline::studies
