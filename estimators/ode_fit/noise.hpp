#pragma once

#include "ode_fit/layout.hpp"

namespace flexspline::estimators {

/// Weighs the layout's outputs anew by what they leave at q, with the parameters that are not on a
/// bound taken from it, and keeps a record in `noise` (against the sigmas of the description).
/// Outputs of the same number share their noise over experiments. Returns the largest relative
/// change of a weight. Errors: numerics, where q cannot be integrated or an output is fitted
/// without any residual.
Result<double> weigh_anew(OdeLayout& layout, std::span<const double> q,
                          const std::vector<bool>& bound_active, const OdeFitSettings& settings,
                          std::vector<OutputNoise>& noise);

/// Standard deviations, intervals and covariance of a fit in coloured noise, widened by what is not
/// known of the noise: its share and time were estimated too (noise_mixture.hpp). Nothing where
/// every output is white.
Result<void> widen_for_noise(const OdeLayout& layout, std::span<const double> q,
                             const std::vector<bool>& bound_active, double tolerance,
                             const std::vector<OutputNoise>& noise, OdeFit& fit);

}  // namespace flexspline::estimators
