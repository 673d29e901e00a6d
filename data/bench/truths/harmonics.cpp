#include "bench/smooth_base.hpp"

namespace flexspline::data {
namespace {

BenchTruth make() {
  BenchTruth truth = smooth_base();
  truth.harmonics = bench_harmonics();
  return truth;
}

}  // namespace

TruthRow describe_harmonics() {
  return {"harmonics", "h = 1; 3 % third and 2 % second harmonic in the sine",
          "smooth stand-in for Table I, strictly monotone everywhere", make};
}

}  // namespace flexspline::data
