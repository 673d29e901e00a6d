#include "posterior/posterior_bands.hpp"

#include <cmath>
#include <functional>

namespace flexspline::estimators {
namespace {

constexpr double kNormal95 = 1.959963984540054;

using Law95 = std::function<std::array<double, 2>(double)>;

std::array<double, 2> ends_of(const std::array<double, 2>& law) {
  return {law[0] - kNormal95 * law[1], law[0] + kNormal95 * law[1]};
}

FunctionBand band_between(std::string function, const LawSpec& spec, double from, double to,
                          const Law95& ends) {
  const auto law = make_law(spec);
  expects(law.has_value(), "the laws of an estimate can be made");
  FunctionBand band{.function = std::move(function), .valid_from = from, .valid_to = to};
  for (const double x : band_arguments(from, to)) {
    const auto [lower, upper] = ends(x);
    band.argument.push_back(x);
    band.value.push_back((*law)->value(x));
    band.lower.push_back(lower);
    band.upper.push_back(upper);
  }
  return band;
}

}  // namespace

std::vector<FunctionBand> posterior_bands(const TorsionPosterior& posterior,
                                          const TorsionLayout& layout, std::span<const double> p,
                                          const Domain& domain) {
  std::vector<FunctionBand> bands;
  bands.push_back(band_between("f", layout.f(p), domain.motion_from, domain.motion_to,
                               [&](double x) { return ends_of(posterior.f_at(x)); }));
  bands.push_back(band_between("g_inverse", layout.g_inverse(p), -domain.velocity, domain.velocity,
                               [&](double w) { return ends_of(posterior.g_inverse_at(w)); }));
  if (posterior.at.h >= 0) {
    bands.push_back(
        band_between("h", layout.h(p), domain.motion_from, domain.motion_to, [&](double x) {
          const auto [lower, upper] = ends_of(posterior.log_h_at(x));
          return std::array<double, 2>{std::exp(lower), std::exp(upper)};
        }));
  }
  return bands;
}

}  // namespace flexspline::estimators
