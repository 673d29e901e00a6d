#pragma once

#include <cstdint>
#include <vector>

#include "flexspline/estimators/given_parameters.hpp"

namespace flexspline::estimators {

/// Another start of a given model: what is free and has a start other than zero is drawn within a
/// factor of 4 about it (the logarithm uniform, the sign kept) and within its bounds. The first
/// start is the one given; each depends on the seed and its number alone.
std::vector<GivenParameter> drawn_start(std::vector<GivenParameter> given, std::uint64_t seed,
                                        int start);

}  // namespace flexspline::estimators
