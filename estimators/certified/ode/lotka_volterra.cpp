#include "certified/ode_rows.hpp"

namespace flexspline::estimators {
namespace {

// Prey and predator, ten samples of both.
class LotkaVolterra final : public OdeLaw<LotkaVolterra> {
 public:
  std::size_t states() const override { return 2; }
  std::size_t parameters() const override { return 4; }
  template <class S>
  void law(double, std::span<const S> y, std::span<const S> p, std::span<S> ydot) const {
    const S met(y[0] * y[1]);
    ydot[0] = S(S(p[1] * met) - S(p[0] * y[0]));
    ydot[1] = S(S(p[2] * y[1]) - S(p[3] * met));
  }
};

const std::vector<double> kTimes = {
    1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0,
};

// One line a time, one column a state.
const std::vector<double> kMeasured = {
    0.58462429,  1.653802752, 1.480323792, 1.898433328, 1.941197515, 0.791087389, 1.266090393,
    0.402385741, 0.68499583,  0.435968041, 0.435253441, 0.725707829, 0.404814065, 1.244405746,
    0.822427034, 2.052562952, 1.771604896, 1.426515341, 1.754832745, 0.548344791,
};

}  // namespace

CertifiedOde describe_lotka_volterra() {
  CertifiedOde row{.name = "lotka_volterra", .title = "Lotka-Volterra"};
  row.source =
      "data of Schittkowski (2002) as in PSOPT's example predator; optimum found independently";
  row.problem.system = std::make_shared<LotkaVolterra>();
  row.problem.parameters = rates("theta", {0.8, 0.8, 0.8, 0.8}, "1");
  row.problem.experiments = {fully_observed("lotka_volterra", {0.4, 1.0}, kTimes, kMeasured)};
  row.sum_of_squares = 0.027536379089076045;
  row.parameters = {
      0.9837424300386838,
      0.9803889160406962,
      1.0169075505455327,
      1.022713281123032,
  };
  row.std = {
      0.02402501832812555,
      0.021595898616417846,
      0.02281906331548477,
      0.02667455157551722,
  };
  return row;
}

}  // namespace flexspline::estimators
