#include "bench/slip_fit.hpp"
#include "bench/smooth_base.hpp"

namespace flexspline::data {
namespace {

double linear_damping(double speed) { return 0.3 * 4.47 * speed / kPaperSpeed; }

BenchTruth make() {
  BenchTruth truth = slip_truth(0.7);
  truth.damping = linear_damping;
  return truth;
}

}  // namespace

TruthRow describe_rate_independent_viscous() {
  return {"rate_independent_viscous", "70 % of the slip elements, 30 % linear viscosity",
          "as rate_independent; 4.47 Nm is Table I's peak g^-1", make};
}

}  // namespace flexspline::data
