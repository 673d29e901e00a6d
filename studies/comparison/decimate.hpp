#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace flexspline::studies {

/// At most this many points of a series are kept in an artefact.
inline constexpr std::size_t kKeptPoints = 400;

/// Indices of [first, last), evenly thinned out to at most kKeptPoints, both ends included.
std::vector<std::size_t> kept_indices(std::size_t first, std::size_t last);

/// The series at the indices.
std::vector<double> at_indices(std::span<const double> series,
                               std::span<const std::size_t> indices);

}  // namespace flexspline::studies
