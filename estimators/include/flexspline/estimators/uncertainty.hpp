#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace flexspline::estimators {

/// Where 95 % intervals come from: the covariance of the linearised model (symmetric, none for a
/// parameter on a bound), the profile likelihood, or refits to the model's own prediction with
/// noise drawn from the normal law or from blocks of the residuals.
enum class Uncertainty { covariance, profile, bootstrap_parametric, bootstrap_block };

/// All of them, the default first.
std::span<const Uncertainty> uncertainties();
std::string_view name_of(Uncertainty uncertainty);
std::optional<Uncertainty> find_uncertainty(std::string_view name);

struct UncertaintySettings {
  Uncertainty kind = Uncertainty::covariance;
  std::size_t replicates = 200;  ///< of the bootstrap, at least 20 for percentiles to mean much
  std::uint64_t seed = 1;
};

}  // namespace flexspline::estimators
