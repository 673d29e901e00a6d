#include "bench/smooth_base.hpp"

namespace flexspline::data {
namespace {

BenchTruth make() {
  BenchTruth truth = smooth_base();
  truth.log_modulation = even_modulation;
  return truth;
}

}  // namespace

TruthRow describe_h_even() {
  return {"h_even", "ln h = 0.3 x^2, x = phi / 0.2 deg",
          "smooth stand-in for Table I, strictly monotone everywhere", make};
}

}  // namespace flexspline::data
