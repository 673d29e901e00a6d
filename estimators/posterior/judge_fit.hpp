#pragma once

#include "posterior/torsion_posterior.hpp"
#include "uncertainty/bands.hpp"

namespace flexspline::estimators {

/// Bands and verdict of a fit that the recordings have been asked about without its classes.
struct JudgedFit {
  std::vector<FunctionBand> bands;
  Identifiability identifiability;
};

/// Replaces the bands by those of the posterior, and takes the verdict `identifiable` back: `weak`
/// where recordings leave more than their noise whatever f, g^-1 and h are, or where the class of
/// the fit moves ln h (root mean square over the domain) by more than its band; `not_identifiable`,
/// and no band of h, where what is left is more than half as much again as the noise.
JudgedFit judged(const TorsionPosterior& posterior, const TorsionLayout& layout,
                 std::span<const double> p, const Domain& domain, Identifiability before);

}  // namespace flexspline::estimators
