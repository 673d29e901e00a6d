#include <cmath>

#include <fmt/format.h>

#include "diagnosis/model/cause_columns.hpp"
#include "diagnosis/model/model.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Values = std::span<const double>;

constexpr double kMostExcess = 0.12;  // a tenth stiffer and a tenth softer, and its interval

Columns size_of_f(Equation, const Frame&, const Reference& reference, Values) {
  return {reference.elastic.abs()};
}

std::vector<Shape> width(const Frame&) {
  return {
      {.name = "width",
       .unit = "1",
       .lower = 0.1,
       .upper = 2.0,
       .meaning = "of the torque, over its largest, in which the sides go over into each other"}};
}

// Its largest is that of size_of_f.
Columns rounded_size_of_f(Equation, const Frame& f, const Reference& reference, Values shape) {
  const double largest = (reference.elastic.abs() * f.usable).maxCoeff();
  if (!(largest > 0.0)) return {ArrayXd::Zero(f.rows())};
  const ArrayXd side = (reference.elastic / (shape[0] * largest)).tanh();
  return {reference.elastic * side / std::tanh(1.0 / shape[0])};
}

Counterpart as_sides(const FittedCause& c) { return {.spring_difference = c.coefficients[0]}; }

Counterpart as_rounded_sides(const FittedCause& c) {
  return {.spring_difference = c.coefficients[0],
          .caveat = "its sides differ from rest on, not more and more"};
}

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
                     .counterpart = as_sides},
                    {.equation = "f(x) (1 + a tanh(f/(w F))/tanh(1/w)), F the largest |f|",
                     .rigs = kAnyRig,
                     .at = {Equation::torsion},
                     .shapes = width,
                     .terms = excess,
                     .columns = rounded_size_of_f,
                     .extends = true,
                     .where = wound_up,
                     .counterpart = as_rounded_sides}},
          .part = BaselinePart{.most = kMostExcess, .says = in_words}};
}

}  // namespace flexspline::studies
