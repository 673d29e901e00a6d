#include <fmt/format.h>

#include "diagnosis/model/cause_columns.hpp"
#include "diagnosis/model/model.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Values = std::span<const double>;

constexpr double kMostExcess = 0.06;  // the sides of a gear differ by a tenth

Columns size_of_f(Equation, const Frame&, const Reference& reference, Values) {
  return {reference.elastic.abs()};
}

Counterpart as_sides(const FittedCause& c) { return {.spring_difference = c.coefficients[0]}; }

std::vector<Term> excess(const Frame&) {
  return {{"excess", "1", "by which f is stiffer on its positive side, and softer on the other"}};
}

std::string in_words(const Frame&, const DriveModel& model, std::size_t cause) {
  return fmt::format("the spring is {:.2g} % stiffer at positive torsion than at negative",
                     200.0 * model.coefficients[cause][0]);
}

}  // namespace

CauseRow describe_asymmetric_spring() {
  return {.id = "asymmetric_spring",
          .coordinate = "torsion",
          .forms = {{.equation = "f(x) (1 + a sgn(x))",
                     .rigs = kAnyRig,
                     .at = {Equation::torsion},
                     .terms = excess,
                     .columns = size_of_f,
                     .where = wound_up,
                     .counterpart = as_sides}},
          .part = BaselinePart{.most = kMostExcess, .says = in_words}};
}

}  // namespace flexspline::studies
