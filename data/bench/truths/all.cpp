#include "bench/smooth_base.hpp"

namespace flexspline::data {
namespace {

BenchTruth make() {
  BenchTruth truth = smooth_base();
  truth.stiffness = asymmetric_stiffness;
  truth.damping = asymmetric_damping;
  truth.log_modulation = even_odd_modulation;
  truth.harmonics = bench_harmonics();
  truth.sensor_lag_s = kBenchLag;
  truth.inertia = kBenchInertia;
  return truth;
}

}  // namespace

TruthRow describe_all() {
  return {"all", "h even and odd, f and g^-1 asymmetric, harmonics, lag and inertia at once",
          "smooth stand-in for Table I, strictly monotone everywhere", make};
}

}  // namespace flexspline::data
