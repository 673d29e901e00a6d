#include "certified/ode_rows.hpp"

namespace flexspline::estimators {
namespace {

// Methanol to hydrocarbons. The last rate ends on its bound 0.
class Methanol final : public OdeLaw<Methanol> {
 public:
  std::size_t states() const override { return 3; }
  std::size_t parameters() const override { return 5; }
  template <class S>
  void law(double, std::span<const S> y, std::span<const S> p, std::span<S> ydot) const {
    const S site(S(S(p[1] + p[4]) * y[0]) + y[1]);
    const S through(S(p[0] * y[0]) / site);
    const S used(S(S(2.0 * p[1]) + p[2]) + p[3]);
    ydot[0] = S(S(through * y[1]) - S(used * y[0]));
    ydot[1] = S(S(through * S(S(p[1] * y[0]) - y[1])) + S(p[2] * y[0]));
    ydot[2] = S(S(through * S(y[1] + S(p[4] * y[0]))) + S(p[3] * y[0]));
  }
};

const std::vector<double> kTimes = {
    0.0,   0.05,  0.065, 0.08,  0.123, 0.233, 0.273, 0.354, 0.397,
    0.418, 0.502, 0.553, 0.681, 0.75,  0.916, 0.937, 1.122,
};

// One line a time, one column a state.
const std::vector<double> kMeasured = {
    1.0,    0.0,    0.0,    0.7085, 0.1621, 0.0811, 0.5971, 0.1855, 0.0965, 0.5537, 0.1989,
    0.1198, 0.3684, 0.2845, 0.1535, 0.1712, 0.3491, 0.2097, 0.1198, 0.3098, 0.2628, 0.0747,
    0.3576, 0.2467, 0.0529, 0.3347, 0.2884, 0.0415, 0.3388, 0.2757, 0.0261, 0.3557, 0.3167,
    0.0208, 0.3483, 0.2954, 0.0085, 0.3836, 0.295,  0.0053, 0.3611, 0.2937, 0.0019, 0.3609,
    0.2831, 0.0018, 0.3485, 0.2846, 0.0006, 0.3698, 0.2899,
};

}  // namespace

CertifiedOde describe_methanol() {
  CertifiedOde row{.name = "methanol", .title = "Methanol-to-hydrocarbons"};
  row.source = "COPS 3.0, Dolan, More and Munson (2004), ANL/MCS-273, table as in COPSBenchmark.jl";
  row.problem.system = std::make_shared<Methanol>();
  row.problem.parameters = rates("theta", {1.0, 1.0, 1.0, 1.0, 1.0}, "1");
  row.problem.experiments = {fully_observed("methanol", {1.0, 0.0, 0.0}, kTimes, kMeasured)};
  row.published_sum = 0.00902229;
  row.sum_of_squares = 0.009022289850875765;
  row.parameters = {
      1.7751810722736487, 2.1679829403858, 1.8575594657557182, 1.8024472992244889, 0.0,
  };
  // Over 51 - 4 degrees of freedom: the rate on its bound is not counted.
  row.std = {
      0.29736845539054313, 0.15052888590406896, 0.19560093029940517,
      0.07384291305078304, kNotComputed,
  };
  return row;
}

}  // namespace flexspline::estimators
