#include "bench/smooth_base.hpp"

namespace flexspline::data {
namespace {

BenchTruth make() {
  BenchTruth truth = smooth_base();
  truth.sensor_lag_s = kBenchLag;
  return truth;
}

}  // namespace

TruthRow describe_sensor_lag() {
  return {"sensor_lag", "h = 1; torque late by 0.95 s, 1.7 deg of the paper's cycle",
          "smooth stand-in for Table I, strictly monotone everywhere", make};
}

}  // namespace flexspline::data
