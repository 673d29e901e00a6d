#pragma once

#include <cstddef>
#include <vector>

namespace flexspline::studies {

/// Designs and indices of global sensitivity analysis, on the unit cube of d parameters.
///
/// Sobol: rows of Saltelli's design, n (d + 2) of them, block by block: A, B, and for each i the
/// rows A with column i out of B. First-order index S_i = mean(f_B (f_ABi - f_A)) / V (Saltelli et
/// al., 2010), total index T_i = mean((f_A - f_ABi)^2) / (2 V) (Jansen, 1999), V the variance of
/// f_A and f_B together.
/// Morris: r trajectories of d + 1 rows, each step moving one parameter by delta = p / (2 (p - 1))
/// on a grid of p = 4 levels (Morris, 1991); mu* = mean |elementary effect| (Campolongo et al.,
/// 2007), sigma its standard deviation. An effect is per unit of the cube.
std::vector<std::vector<double>> saltelli_design(std::size_t n, std::size_t dimensions);
std::vector<std::vector<double>> morris_design(std::size_t trajectories, std::size_t dimensions,
                                               unsigned long seed);

struct SobolIndex {
  double first = 0.0, total = 0.0;
  double first_std = 0.0, total_std = 0.0;  ///< by the jackknife over ten blocks of the sample
};

/// values: of the design's rows, in their order. Samples with a value that is NaN in any block are
/// left out everywhere.
std::vector<SobolIndex> sobol_indices(const std::vector<double>& values, std::size_t dimensions);

struct MorrisEffect {
  double mean = 0.0;      ///< signed
  double mean_abs = 0.0;  ///< mu*
  double deviation = 0.0;
};
std::vector<MorrisEffect> morris_effects(const std::vector<std::vector<double>>& design,
                                         const std::vector<double>& values, std::size_t dimensions);

}  // namespace flexspline::studies
