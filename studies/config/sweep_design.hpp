#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace flexspline::studies {

/// Points in the unit cube. Latin hypercube: one point in each of `count` slices of every
/// dimension, drawn by the seed. Sobol: the first `count` points of the sequence, the origin apart.
std::vector<std::vector<double>> latin_hypercube(std::size_t count, std::size_t dimensions,
                                                 std::uint64_t seed);
std::vector<std::vector<double>> sobol_points(std::size_t count, std::size_t dimensions);

}  // namespace flexspline::studies
