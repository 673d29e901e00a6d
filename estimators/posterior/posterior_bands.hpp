#pragma once

#include "posterior/torsion_posterior.hpp"
#include "uncertainty/bands.hpp"

namespace flexspline::estimators {

/// Pointwise 95 % bands of f, g^-1 and (where the posterior has it) h about the posterior's mean,
/// with the values of the laws at p, drawn as far as those of torsion_bands: beyond the domain they
/// open as the prior lets the functions wander. f is counted from f(0).
std::vector<FunctionBand> posterior_bands(const TorsionPosterior& posterior,
                                          const TorsionLayout& layout, std::span<const double> p,
                                          const Domain& domain);

}  // namespace flexspline::estimators
