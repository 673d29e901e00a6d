#include "bench/slip_fit.hpp"
#include "bench/smooth_base.hpp"

namespace flexspline::data {
namespace {

BenchTruth make() { return slip_truth(1.0); }

}  // namespace

TruthRow describe_rate_independent() {
  return {"rate_independent", "six slip elements that match Table I's half height; no viscosity",
          "non-negative least squares on Table I's g^-1 at 0.2 deg, 0.005 Hz", make};
}

}  // namespace flexspline::data
