#include "bench/smooth_base.hpp"

namespace flexspline::data {
namespace {

BenchTruth make() {
  BenchTruth truth;
  truth.stiffness = table_one_stiffness;
  truth.damping = table_one_damping;
  truth.log_modulation = no_modulation;
  return truth;
}

}  // namespace

TruthRow describe_table_i() {
  return {"table_i",
          "Table I as printed, h = 1; f rises to 118 %, g^-1 to 113 % of their range only",
          "Dhaouadi and Ghorbel (2003), Table I", make};
}

}  // namespace flexspline::data
