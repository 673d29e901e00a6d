#include "bench/smooth_base.hpp"

namespace flexspline::data {
namespace {

BenchTruth make() {
  BenchTruth truth = smooth_base();
  truth.stiffness = asymmetric_stiffness;
  return truth;
}

}  // namespace

TruthRow describe_f_asymmetric() {
  return {"f_asymmetric", "h = 1; f with x^2 * 1 Nm (6 %), x = phi / 0.2 deg",
          "smooth stand-in for Table I, strictly monotone everywhere", make};
}

}  // namespace flexspline::data
