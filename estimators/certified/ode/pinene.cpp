#include "certified/ode_rows.hpp"

namespace flexspline::estimators {
namespace {

// Isomerisation of alpha-pinene: linear, with rates of some 1e-5 a minute.
class Pinene final : public OdeLaw<Pinene> {
 public:
  std::size_t states() const override { return 5; }
  std::size_t parameters() const override { return 5; }
  template <class S>
  void law(double, std::span<const S> y, std::span<const S> p, std::span<S> ydot) const {
    ydot[0] = S(-S(S(p[0] + p[1]) * y[0]));
    ydot[1] = S(p[0] * y[0]);
    ydot[2] = S(S(S(p[1] * y[0]) - S(S(p[2] + p[3]) * y[2])) + S(p[4] * y[4]));
    ydot[3] = S(p[2] * y[2]);
    ydot[4] = S(S(p[3] * y[2]) - S(p[4] * y[4]));
  }
};

const std::vector<double> kTimes = {
    1230.0, 3060.0, 4920.0, 7800.0, 10680.0, 15030.0, 22620.0, 36420.0,
};

// One line a time, one column a state.
const std::vector<double> kMeasured = {
    88.35, 7.3,  2.3,  0.4,  1.75, 76.4, 15.6, 4.5,  0.7,  2.8, 65.1, 23.1, 5.3,  1.1,
    5.8,   50.4, 32.9, 6.0,  1.5,  9.3,  37.5, 42.7, 6.0,  1.9, 12.0, 25.9, 49.1, 5.9,
    2.2,   17.0, 14.0, 57.4, 5.1,  2.6,  21.0, 4.5,  63.1, 3.8, 2.9,  25.7,
};

}  // namespace

CertifiedOde describe_pinene() {
  CertifiedOde row{.name = "pinene", .title = "Isomerization of alpha-pinene"};
  row.source = "COPS 3.0, Dolan, More and Munson (2004), ANL/MCS-273, table as in COPSBenchmark.jl";
  row.problem.system = std::make_shared<Pinene>();
  row.problem.parameters = rates("theta", {5.8e-05, 2.9e-05, 2e-05, 0.00027, 4e-05}, "1", 1e-5);
  row.problem.experiments = {
      fully_observed("pinene", {100.0, 0.0, 0.0, 0.0, 0.0}, kTimes, kMeasured)};
  row.published_sum = 19.8721;
  row.sum_of_squares = 19.8721669340473;
  row.parameters = {
      5.925848768837727e-05,  2.963402117430465e-05, 2.0472840367714246e-05,
      0.00027446795188858036, 3.997950756613335e-05,
  };
  row.std = {
      5.071165344023684e-07, 4.911119045636249e-07, 3.09504087805839e-06,
      2.320654797547855e-05, 8.383943826993117e-06,
  };
  return row;
}

}  // namespace flexspline::estimators
