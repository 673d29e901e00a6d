#include <vector>

#include "diagnosis/cause_columns.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Values = std::span<const double>;

Columns size_of_f(Equation, const Frame&, const Reference& reference, Values) {
  return {reference.elastic.abs()};
}

Counterpart as_sides(const FittedCause& c) { return {.spring_difference = c.coefficients[0]}; }

std::vector<Term> excess(const Frame&) {
  return {{"excess", "1", "by which f is stiffer on its positive side, and softer on the other"}};
}

}  // namespace

std::span<const CauseRow> baseline_parts() {
  static const std::vector<CauseRow> parts = {{.id = "asymmetric_spring",
                                               .coordinate = "torsion",
                                               .forms = {{.equation = "f(x) (1 + a sgn(x))",
                                                          .rigs = kAnyRig,
                                                          .at = {Equation::torsion},
                                                          .terms = excess,
                                                          .columns = size_of_f,
                                                          .where = wound_up,
                                                          .counterpart = as_sides}},
                                               .of_baseline = true}};
  return parts;
}

}  // namespace flexspline::studies
