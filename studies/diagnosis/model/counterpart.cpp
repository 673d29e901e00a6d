#include "diagnosis/model/counterpart.hpp"

#include <cmath>

namespace flexspline::studies {

using Parameters = std::vector<std::pair<std::string, double>>;

Parameters amplitude_and_phase(double s, double c) {
  return {{"amplitude", std::hypot(s, c)}, {"phase", std::atan2(c, s)}};
}

Parameters harmonic(double order, double s, double c) {
  return {{"amplitude", std::hypot(s, c)}, {"order", order}, {"phase", std::atan2(c, s)}};
}

std::vector<EffectSpec> by_sign_part(std::span<const SignPart> sign, std::string_view effect,
                                     const std::function<Parameters(double, double)>& parameters) {
  std::vector<EffectSpec> effects;
  for (const SignPart& part : sign) {
    effects.push_back({std::string(effect), parameters(part.share, part.width)});
  }
  return effects;
}

}  // namespace flexspline::studies
