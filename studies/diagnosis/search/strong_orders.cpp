#include "diagnosis/search/strong_orders.hpp"

#include <algorithm>
#include <complex>
#include <ranges>

namespace flexspline::studies {

std::vector<double> strong_orders(const Frame& frame, const Findings& findings, Equation equation,
                                  int from, int to, std::size_t most) {
  using std::ranges::greater;
  const std::size_t e = index_of(equation);
  const Eigen::ArrayXcd turn = (std::complex<double>(0.0, 1.0) * frame.motor_angle).exp();
  Eigen::ArrayXcd wave =
      findings.fit.residual[e] * findings.weight[e].square() * turn.pow(static_cast<double>(from));
  std::vector<std::pair<double, double>> by_strength;
  for (int order = from; order <= to; ++order) {
    by_strength.emplace_back(std::abs(wave.sum()), order);
    wave *= turn;
  }
  std::ranges::sort(by_strength, greater{});
  by_strength.resize(std::min(most, by_strength.size()));
  const auto orders = by_strength | std::views::values;
  return {orders.begin(), orders.end()};
}

}  // namespace flexspline::studies
