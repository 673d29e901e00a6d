#pragma once

#include <string>
#include <utility>
#include <vector>

namespace flexspline {

/// A law f, g^-1 or h as plain data: which class, at what scale, with which numbers. SI units.
struct LawSpec {
  std::string law;            ///< id in the catalogue of laws
  double scale = 1.0;         ///< argument that maps to 1: range of the data it was fitted on
  std::vector<double> knots;  ///< interior knots on (0, 1) or (-1, 1), where the class has any
  std::vector<double> coefficients;  ///< in the law's own order
  double valid_to = 0.0;             ///< |argument| up to which recordings support it; 0: unknown

  bool operator==(const LawSpec&) const = default;
};

/// f and g^-1 of a transmission that is rigid and has no law: zero.
inline LawSpec rigid_law() {
  return {.law = "odd_polynomial", .scale = 1.0, .knots = {}, .coefficients = {0.0}};
}

/// An effect that is added to the torsion law, by its id in the catalogue of effects.
struct EffectSpec {
  std::string effect;
  std::vector<std::pair<std::string, double>> parameters;  ///< SI
  std::string note = {};  ///< what a reader of the file should know of it
  /// Of an effect at the motor or the load: it stands across the transmission instead, and the
  /// torsion is the angle of both. On a specimen every effect does.
  bool across = false;
};

/// The torsion law tau = f(phi) + g^-1(phi'/h(phi)), Dhaouadi and Ghorbel (2003), eq. (4), with
/// effects beyond it. phi in rad (m), tau in Nm (N).
struct ModelSpec {
  LawSpec f;
  LawSpec g_inverse;
  LawSpec h;
  std::vector<EffectSpec> effects;
};

}  // namespace flexspline
