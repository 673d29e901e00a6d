#include "bench/smooth_base.hpp"

namespace flexspline::data {
namespace {

BenchTruth make() {
  BenchTruth truth = smooth_base();
  truth.damping = asymmetric_damping;
  return truth;
}

}  // namespace

TruthRow describe_g_asymmetric() {
  return {"g_asymmetric", "h = 1; g^-1 15 % stronger forwards, 15 % weaker backwards",
          "smooth stand-in for Table I, strictly monotone everywhere", make};
}

}  // namespace flexspline::data
