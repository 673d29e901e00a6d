#include <fmt/format.h>

#include "certified/ode_rows.hpp"

namespace flexspline::estimators {
namespace {

constexpr std::size_t kStagesOfLife = 8;

// Stages of life with mortalities m and growths g into the next; initial numbers are free.
class Marine final : public OdeLaw<Marine> {
 public:
  std::size_t states() const override { return 8; }
  std::size_t parameters() const override { return 15; }
  template <class S>
  void law(double, std::span<const S> y, std::span<const S> p, std::span<S> ydot) const {
    S gained(0.0);
    for (std::size_t s = 0; s < kStagesOfLife; ++s) {
      const bool last = s + 1 == kStagesOfLife;
      const S grown(last ? S(0.0) : S(p[kStagesOfLife + s] * y[s]));
      ydot[s] = S(S(gained - S(p[s] * y[s])) - grown);
      gained = grown;
    }
  }
};

const std::vector<double> kTimes = {
    0.0, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 3.5, 4.0, 4.5,  5.0,
    5.5, 6.0, 6.5, 7.0, 7.5, 8.0, 8.5, 9.0, 9.5, 10.0,
};

// One line a time, one column a state.
const std::vector<double> kMeasured = {
    20000.0, 17000.0, 10000.0, 15000.0, 12000.0, 9000.0,  7000.0,  3000.0,  12445.0, 15411.0,
    13040.0, 13338.0, 13484.0, 8426.0,  6615.0,  4022.0,  7705.0,  13074.0, 14623.0, 11976.0,
    12453.0, 9272.0,  6891.0,  5020.0,  4664.0,  8579.0,  12434.0, 12603.0, 11738.0, 9710.0,
    6821.0,  5722.0,  2977.0,  7053.0,  11219.0, 11340.0, 13665.0, 8534.0,  6242.0,  5695.0,
    1769.0,  5054.0,  10065.0, 11232.0, 12112.0, 9600.0,  6647.0,  7034.0,  943.0,   3907.0,
    9473.0,  10334.0, 11115.0, 8826.0,  6842.0,  7348.0,  581.0,   2624.0,  7421.0,  10297.0,
    12427.0, 8747.0,  7199.0,  7684.0,  355.0,   1744.0,  5369.0,  7748.0,  10057.0, 8698.0,
    6542.0,  7410.0,  223.0,   1272.0,  4713.0,  6869.0,  9564.0,  8766.0,  6810.0,  6961.0,
    137.0,   821.0,   3451.0,  6050.0,  8671.0,  8291.0,  6827.0,  7525.0,  87.0,    577.0,
    2649.0,  5454.0,  8430.0,  7411.0,  6423.0,  8388.0,  49.0,    337.0,   2058.0,  4115.0,
    7435.0,  7627.0,  6268.0,  7189.0,  32.0,    228.0,   1440.0,  3790.0,  6474.0,  6658.0,
    5859.0,  7467.0,  17.0,    168.0,   1178.0,  3087.0,  6524.0,  5880.0,  5562.0,  7144.0,
    11.0,    99.0,    919.0,   2596.0,  5360.0,  5762.0,  4480.0,  7256.0,  7.0,     65.0,
    647.0,   1873.0,  4556.0,  5058.0,  4944.0,  7538.0,  4.0,     44.0,    509.0,   1571.0,
    4009.0,  4527.0,  4233.0,  6649.0,  2.0,     27.0,    345.0,   1227.0,  3677.0,  4229.0,
    3805.0,  6378.0,  1.0,     20.0,    231.0,   934.0,   3197.0,  3695.0,  3159.0,  6454.0,
    1.0,     12.0,    198.0,   707.0,   2562.0,  3163.0,  3232.0,  5566.0,
};

}  // namespace

CertifiedOde describe_marine() {
  CertifiedOde row{.name = "marine", .title = "Marine population dynamics"};
  row.source = "COPS 3.0, Dolan, More and Munson (2004), ANL/MCS-273, table as in COPSBenchmark.jl";
  row.problem.system = std::make_shared<Marine>();
  row.problem.parameters = rates("m", std::vector<double>(8, 0.5), "1");
  for (auto& growth : rates("g", std::vector<double>(7, 0.5), "1")) {
    row.problem.parameters.push_back(std::move(growth));
  }
  auto experiment = fully_observed("marine", std::vector<double>(8, 0.0), kTimes, kMeasured);
  for (std::size_t s = 0; s < kStagesOfLife; ++s) {
    OdeParameter number{.name = fmt::format("y{}(0)", s + 1), .start = kMeasured[s]};
    number.scale = kMeasured[s];
    experiment.initial[s] = number;
  }
  row.problem.experiments = {std::move(experiment)};
  row.published_sum = 19746200.0;
  row.sum_of_squares = 19746529.716107924;
  row.parameters = {
      0.27430618263045137, 0.10251215548148335,   0.24818231869380272,
      0.1071805900336316,  0.0014079887589902083, 0.0,
      0.31998189006486927, 0.4391912957576119,    0.6920073229546986,
      0.8076752083299432,  0.4653523291532236,    0.47108356207446056,
      0.4821698253427787,  0.6437568735947082,    0.5422870583046442,
  };
  row.std.assign(row.parameters.size(), kNotComputed);
  return row;
}

}  // namespace flexspline::estimators
