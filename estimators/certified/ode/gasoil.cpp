#include "certified/ode_rows.hpp"

namespace flexspline::estimators {
namespace {

// Gas oil (y1) cracks into gasoline (y2) and others; of second order in gas oil.
class GasOil final : public OdeLaw<GasOil> {
 public:
  std::size_t states() const override { return 2; }
  std::size_t parameters() const override { return 3; }
  template <class S>
  void law(double, std::span<const S> y, std::span<const S> p, std::span<S> ydot) const {
    ydot[0] = S(-S(S(p[0] + p[2]) * S(y[0] * y[0])));
    ydot[1] = S(S(p[0] * S(y[0] * y[0])) - S(p[1] * y[1]));
  }
};

const std::vector<double> kTimes = {
    0.0, 0.025, 0.05, 0.075, 0.1, 0.125, 0.15, 0.175, 0.2,  0.225, 0.25,
    0.3, 0.35,  0.4,  0.45,  0.5, 0.55,  0.65, 0.75,  0.85, 0.95,
};

// One line a time, one column a state.
const std::vector<double> kMeasured = {
    1.0,    0.0,    0.8105, 0.2,    0.6208, 0.2886, 0.5258, 0.301,  0.4345, 0.3215, 0.3903,
    0.3123, 0.3342, 0.2716, 0.3034, 0.2551, 0.2735, 0.2258, 0.2405, 0.1959, 0.2283, 0.1789,
    0.2071, 0.1457, 0.1669, 0.1198, 0.153,  0.0909, 0.1339, 0.0719, 0.1265, 0.0561, 0.12,
    0.046,  0.099,  0.028,  0.087,  0.019,  0.077,  0.014,  0.069,  0.01,
};

}  // namespace

CertifiedOde describe_gasoil() {
  CertifiedOde row{.name = "gasoil", .title = "Catalytic cracking of gas oil"};
  row.source = "COPS 3.0, Dolan, More and Munson (2004), ANL/MCS-273, table as in COPSBenchmark.jl";
  row.problem.system = std::make_shared<GasOil>();
  row.problem.parameters = rates("theta", {12.0, 8.0, 1.0}, "1");
  row.problem.experiments = {fully_observed("gasoil", {1.0, 0.0}, kTimes, kMeasured)};
  row.published_sum = 0.0052366;
  row.sum_of_squares = 0.005236595833832477;
  row.parameters = {
      11.846738379375788,
      8.344519498965001,
      1.0014399702409973,
  };
  row.std = {
      0.3264367316655297,
      0.30778072828665715,
      0.3493451139373318,
  };
  return row;
}

}  // namespace flexspline::estimators
