#include "bench/smooth_base.hpp"

namespace flexspline::data {
namespace {

BenchTruth make() {
  BenchTruth truth = smooth_base();
  truth.inertia = kBenchInertia;
  return truth;
}

}  // namespace

TruthRow describe_inertia() {
  return {"inertia", "h = 1; inertia of 0.8 Nm (5 %) at 0.2 deg, 0.005 Hz",
          "smooth stand-in for Table I, strictly monotone everywhere", make};
}

}  // namespace flexspline::data
