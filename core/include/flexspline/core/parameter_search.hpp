#pragma once

#include <string_view>

namespace flexspline {

/// What the range of a parameter is measured by, of the recordings that it is sought on.
enum class Scale {
  one,           ///< SI
  motor_speed,   ///< largest |speed| of the motor, rad/s
  load_speed,    ///< of the load, rad/s
  torsion,       ///< largest |torsion|, rad
  torsion_rate,  ///< rad/s
  torque,        ///< largest |torque transmitted|, Nm
  duration,      ///< of the longest recording, s
  session,       ///< from the first recording's start to the last one's end, s
};

/// How a diagnosis finds a parameter of an effect, from the effect's law alone: the term at its
/// site is sum_k a_k T(x; shapes), linear in one or several parameters a_k.
struct ParameterSearch {
  enum class Role {
    none,        ///< not said: the effect is not sought by its law
    linear,      ///< an a_k
    phase,       ///< p of sin(x + p), whose amplitude is the effect's one a_k
    shape,       ///< sought between lower and upper
    sign_width,  ///< of a rounded sign of speed: as the dry friction beside it has it
    held,        ///< at its nominal value
    negligible,  ///< a width held at a millionth of the scale
  };

  Role role = Role::none;
  std::string_view meaning{};  ///< for a person; of linear and shape
  Scale scale = Scale::one;
  double lower = 0.0;  ///< of a shape, in units of the scale
  double upper = 0.0;
  int grid = 5;  ///< starts over the range, even in the logarithm
};

inline ParameterSearch linear(std::string_view meaning) {
  return {.role = ParameterSearch::Role::linear, .meaning = meaning};
}
inline ParameterSearch phase() { return {.role = ParameterSearch::Role::phase}; }
inline ParameterSearch shape(std::string_view meaning, double lower, double upper,
                             Scale scale = Scale::one, int grid = 5) {
  return {ParameterSearch::Role::shape, meaning, scale, lower, upper, grid};
}
inline ParameterSearch sign_width() { return {.role = ParameterSearch::Role::sign_width}; }
inline ParameterSearch held() { return {.role = ParameterSearch::Role::held}; }
inline ParameterSearch negligible(Scale scale) {
  return {.role = ParameterSearch::Role::negligible, .scale = scale};
}

}  // namespace flexspline
