#pragma once

#include <array>
#include <span>
#include <vector>

#include "flexspline/core/estimate.hpp"
#include "posterior/mixed_model.hpp"
#include "posterior/torsion_regression.hpp"
#include "torsion/layout.hpp"

namespace flexspline::estimators {

/// Noises that a law leaves where it is refuted: h is refused, and no time is spent on its bands.
/// Gears that follow eq. (4), however rough, leave 0.95 to 1.06; where a search ends elsewhere, 1.4
/// and more, and the band of h holds a seventh of its points.
inline constexpr double kRefutedNoises = 1.1;

/// What the recordings say of f, g^-1 and h where neither is held to a class: the mixed model of
/// eq. (4), tau = o + f(phi) + g^-1(phi'/h(phi)) + J phi'' - d d tau/dt + e, in which f, g^-1 and
/// ln h are penalised splines whose local roughness comes from restricted maximum likelihood, g^-1
/// may jump at zero, the errors of the reconstructed motion are unknowns of known variance, and e
/// is the noise that repeats show. The law of all coefficients given the recordings is normal about
/// its mean, linearised in h.
struct TorsionPosterior {
  RichLaws laws;
  RegressionColumns at;
  bool travels = false;  ///< the joint travels: f holds the offset
  double slowest = 0.0;  ///< rad/s, of the rows; g^-1 is 0 midway between both ways at this speed
  std::vector<PriorGroup> groups{};
  MixedPosterior law{};
  double misfit = 1.0;  ///< root mean square of what is left, in noises of the recordings
  std::vector<std::string> misfits{};  ///< recordings that leave more

  /// Mean and standard deviation of f - f(0) (f where the joint travels), Nm, g^-1, Nm, and ln h.
  std::array<double, 2> f_at(double phi) const;
  std::array<double, 2> g_inverse_at(double speed) const;
  std::array<double, 2> log_h_at(double phi) const;
};

/// layout, p: a fit with classes, which says how fast phi'/h gets. Not modelled: memory, and
/// motions whose zero differs between recordings. Errors: numerics, where the laws
/// of the fit cannot be made, or nothing finite comes out.
Result<TorsionPosterior> torsion_posterior(const std::vector<PreparedRecord>& records,
                                           const TorsionLayout& layout, std::span<const double> p,
                                           bool with_h);

}  // namespace flexspline::estimators
