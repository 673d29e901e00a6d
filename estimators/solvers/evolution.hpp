#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include <Eigen/Core>

namespace flexspline::estimators {

/// A number that is searched for.
struct SearchedNumber {
  double start = 0.0;
  double lower = 0.0;
  double upper = 0.0;
  double step = 1.0;  ///< standard deviation of the first candidates, > 0
};

/// The costs of candidates (columns), in their order; infinite where one has none.
using CostsOf = std::function<std::vector<double>(const Eigen::MatrixXd& candidates)>;

struct EvolutionSettings {
  long evaluations = 1500;  ///< about as many, a whole generation at the end
  std::uint64_t seed = 1;
  double smallest_step = 1e-4;  ///< in first steps: a search this narrow has ended
};

struct Evolved {
  Eigen::VectorXd best;
  double cost = 0.0;  ///< infinite where no candidate had one
  long evaluations = 0;
};

/// The lowest cost that an evolution strategy with covariance adaptation meets (CMA-ES: Hansen and
/// Ostermeier, 2001; weights and constants of Hansen, arXiv 1604.00772). Needs no derivatives,
/// takes ruggedness and cliffs, and promises nothing. Candidates beyond a bound are put on it. The
/// start is one of the candidates. Deterministic for a seed.
Evolved evolve(const CostsOf& costs, const std::vector<SearchedNumber>& numbers,
               const EvolutionSettings& settings);

}  // namespace flexspline::estimators
