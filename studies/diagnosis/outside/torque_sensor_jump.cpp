#include "diagnosis/model/cause_columns.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Values = std::span<const double>;

constexpr double kParts = 40.0;

std::vector<Shape> parts(const Frame&) {
  return {{.name = "part",
           .unit = "1",
           .lower = 1.0,
           .upper = kParts - 1.0,
           .logarithmic = false,
           .discrete = true,
           .meaning = "fortieths of the session, after which it has jumped"}};
}

// Between recordings: within one a step is an incident. So a fold that has no recording on one side
// of it knows nothing of it, in place of a little.
Columns jump(Equation equation, const Frame& f, const Reference&, Values part) {
  ArrayXd after = ArrayXd::Zero(f.rows());
  for (const Segment& s : f.segments) {
    if (f.clock[s.first] >= part[0] / kParts * f.session) after.segment(s.first, s.count).setOnes();
  }
  return of_torque_signal(equation, f, {after});
}

std::vector<Term> terms(const Frame&) { return {{"jump", "Nm", "of the torque sensor's zero"}}; }

bool has_a_course(const Frame& f) { return f.segments.size() > 1 && f.session > 0.0; }

}  // namespace

CauseRow describe_torque_sensor_jump() {
  return {.id = "torque_sensor_jump",
          .coordinate = "time",
          .forms = {{.equation = "tau_measured = tau, and tau + a from one recording on",
                     .rigs = kAnyRig,
                     .at = {Equation::torsion, Equation::load, Equation::motor},
                     .shapes = parts,
                     .terms = terms,
                     .columns = jump,
                     .where = has_a_course,
                     .no_counterpart = "the catalogue of effects has no sensor that jumps"}},
          .outside = "a torque sensor whose zero jumps during the session"};
}

}  // namespace flexspline::studies
