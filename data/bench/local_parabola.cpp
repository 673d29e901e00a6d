#include "bench/local_parabola.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace flexspline::data {
namespace {

constexpr std::size_t kReach = 5;

/// The parabola a + b u + c u^2 of the normal equations, by Cramer's rule.
Jet fit(const std::vector<double>& time, const std::vector<double>& values, std::size_t from,
        std::size_t to, double centre) {
  const double scale = time[to - 1] - time[from];
  std::array<double, 5> power{};
  std::array<double, 3> right{};
  for (std::size_t k = from; k < to; ++k) {
    const double u = (time[k] - centre) / scale;
    double un = 1.0;
    for (std::size_t n = 0; n < 5; ++n, un *= u) {
      power[n] += un;
      if (n < 3) right[n] += un * values[k];
    }
  }
  const auto determinant = [](const std::array<double, 9>& m) {
    return m[0] * (m[4] * m[8] - m[5] * m[7]) - m[1] * (m[3] * m[8] - m[5] * m[6]) +
           m[2] * (m[3] * m[7] - m[4] * m[6]);
  };
  const std::array<double, 9> all = {power[0], power[1], power[2], power[1], power[2],
                                     power[3], power[2], power[3], power[4]};
  std::array<double, 3> solved{};
  for (std::size_t column = 0; column < 3; ++column) {
    std::array<double, 9> with = all;
    for (std::size_t row = 0; row < 3; ++row) with[3 * row + column] = right[row];
    solved[column] = determinant(with) / determinant(all);
  }
  return {solved[0], solved[1] / scale, 2.0 * solved[2] / (scale * scale)};
}

}  // namespace

std::vector<Jet> local_parabolas(const std::vector<double>& time,
                                 const std::vector<double>& values) {
  std::vector<Jet> jets;
  for (std::size_t k = 0; k < values.size(); ++k) {
    const std::size_t from = k < kReach ? 0 : k - kReach;
    jets.push_back(fit(time, values, from, std::min(values.size(), k + kReach + 1), time[k]));
  }
  return jets;
}

}  // namespace flexspline::data
