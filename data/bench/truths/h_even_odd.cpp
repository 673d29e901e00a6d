#include "bench/smooth_base.hpp"

namespace flexspline::data {
namespace {

BenchTruth make() {
  BenchTruth truth = smooth_base();
  truth.log_modulation = even_odd_modulation;
  return truth;
}

}  // namespace

TruthRow describe_h_even_odd() {
  return {"h_even_odd", "ln h = 0.3 x^2 + 0.15 x, x = phi / 0.2 deg",
          "smooth stand-in for Table I, strictly monotone everywhere", make};
}

}  // namespace flexspline::data
