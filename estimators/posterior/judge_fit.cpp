#include "posterior/judge_fit.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "posterior/posterior_bands.hpp"

namespace flexspline::estimators {
namespace {

// Root mean squares over the domain of the distance of ln h of the class from the middle of its
// band, and of the band's half width.
struct Moved {
  double by = 0.0;
  double half_width = 0.0;
};

Moved moved(const FunctionBand& band) {
  Moved sum;
  for (std::size_t k = 0; k < band.argument.size(); ++k) {
    if (band.argument[k] < band.valid_from || band.argument[k] > band.valid_to) continue;
    const double lower = std::log(band.lower[k]);
    const double upper = std::log(band.upper[k]);
    sum.by += std::pow(std::log(band.value[k]) - 0.5 * (lower + upper), 2);
    sum.half_width += std::pow(0.5 * (upper - lower), 2);
  }
  return {std::sqrt(sum.by), std::sqrt(sum.half_width)};
}

std::string misfit_text(const TorsionPosterior& posterior) {
  const std::string where =
      posterior.misfits.empty() ? "" : fmt::format(" ({})", fmt::join(posterior.misfits, ", "));
  return fmt::format(
      "whatever f, g^-1 and h are, eq. (4) leaves {:.3g} times the noise that repeats show{}: "
      "something else is at work, and h may stand in for it",
      posterior.misfit, where);
}

}  // namespace

JudgedFit judged(const TorsionPosterior& posterior, const TorsionLayout& layout,
                 std::span<const double> p, const Domain& domain, Identifiability before) {
  JudgedFit fit{posterior_bands(posterior, layout, p, domain), std::move(before)};
  auto& verdict = fit.identifiability;
  const auto h = std::ranges::find(fit.bands, "h", &FunctionBand::function);
  if (h == fit.bands.end()) return fit;
  if (posterior.misfit > kRefutedNoises) {
    fit.bands.erase(h);
    verdict.verdict = "not_identifiable";
    verdict.says = "h is refused: " + misfit_text(posterior);
  } else if (const Moved by = moved(*h); by.by > by.half_width) {
    verdict.verdict = "weak";
    verdict.says = fmt::format(
        "the class of h in the model moves ln h by {:.2g} times its band: read the band of h, "
        "which "
        "holds without the class, not the parameters",
        by.by / by.half_width);
  } else if (!posterior.misfits.empty()) {
    verdict.verdict = "weak";
    verdict.says = misfit_text(posterior);
  }
  return fit;
}

}  // namespace flexspline::estimators
