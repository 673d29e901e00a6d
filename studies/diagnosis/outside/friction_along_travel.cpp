#include <numbers>

#include "diagnosis/frame/coordinates.hpp"
#include "diagnosis/model/cause_columns.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Values = std::span<const double>;

// Three harmonics of twice the travel.
Columns along_travel(Equation, const Frame& f, const Reference& known, Values) {
  const ArrayXd sign = rounded_sign(f.torsion_rate, known.torsion_sign);
  const double low = f.torsion.minCoeff();
  const ArrayXd u = std::numbers::pi * (f.torsion - low) / (f.torsion.maxCoeff() - low);
  return {u.cos() * sign, (2.0 * u).cos() * sign, (3.0 * u).cos() * sign};
}

std::vector<Term> travel_terms(const Frame&) {
  return {{"cosine_1", "Nm", "of the friction over the travel, half a wave"},
          {"cosine_2", "Nm", "one wave"},
          {"cosine_3", "Nm", "one and a half waves"}};
}

}  // namespace

// What a bearing, a seal or a cable adds at one place of the travel and not at another.
CauseRow describe_friction_along_travel() {
  return {.id = "friction_along_travel",
          .coordinate = "load_angle",
          .forms = {{.equation = "tau += sum_k a_k cos(k pi s) sgn q', s the share of the travel",
                     .rigs = {Rig::specimen},
                     .at = {Equation::torsion},
                     .terms = travel_terms,
                     .columns = along_travel,
                     .where = travels,
                     .no_counterpart =
                         "position_dependent_friction goes by turns of the wave generator"}},
          .outside = "a friction that differs along the travel"};
}

}  // namespace flexspline::studies
