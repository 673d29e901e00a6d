#pragma once

#include <cmath>
#include <random>

#include <Eigen/Core>

namespace flexspline::studies {

/// x_k = rho x_{k-1} + e_k, of unit variance. rho = 0: white.
inline Eigen::ArrayXd coloured_noise(Eigen::Index count, double rho, unsigned seed) {
  std::mt19937_64 generator(seed);
  std::normal_distribution<double> normal;
  Eigen::ArrayXd noise(count);
  double state = normal(generator);
  for (Eigen::Index k = 0; k < count; ++k) {
    noise[k] = state;
    state = rho * state + std::sqrt(1.0 - rho * rho) * normal(generator);
  }
  return noise;
}

}  // namespace flexspline::studies
