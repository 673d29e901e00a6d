#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <span>
#include <string_view>

#include "gears.hpp"

namespace flexspline::estimators {

/// Functions of x = phi / kAmplitude, of z = (phi'/h) / kSpeed, and ln h of x; the torques in units
/// of kPeak. None is of a class that an estimator fits.
using Shape = std::function<double(double)>;

struct DrawnGear {
  Shape f, g_inverse, log_h;
};

using Draw = std::mt19937_64;

inline double uniform(Draw& draw, double from, double to) {
  return from + (to - from) * (static_cast<double>(draw() >> 11U) * 0x1.0p-53);
}

inline double either(Draw& draw, double value) { return draw() & 1U ? value : -value; }

// ---- f

inline Shape stiffening(Draw& draw) {
  const double a = uniform(draw, 0.8, 2.2);
  const double share = uniform(draw, 0.3, 0.7);
  return
      [=](double x) { return 0.7 * (share * x + (1.0 - share) * std::sinh(a * x) / std::sinh(a)); };
}

inline Shape asymmetric_spring(Draw& draw) {
  const double a = either(draw, uniform(draw, 0.3, 0.9));
  const double b = uniform(draw, 1.0, 2.0);
  return [=](double x) { return 0.4 * std::expm1(a * x) / a + 0.25 * std::atan(b * x) / b; };
}

/// Piecewise linear with kinks at drawn places, not odd.
inline Shape kinked_spring(Draw& draw) {
  const double low = uniform(draw, -0.75, -0.25);
  const double high = uniform(draw, 0.2, 0.8);
  const double inner = uniform(draw, 0.25, 0.5);
  const double left = uniform(draw, 0.3, 0.8);
  const double right = uniform(draw, 0.3, 0.8);
  return [=](double x) {
    return inner * x + left * std::min(x - low, 0.0) + right * std::max(x - high, 0.0);
  };
}

inline Shape bent_spring(Draw& draw) {
  const double slope = uniform(draw, 0.5, 0.7);
  const double bend = either(draw, uniform(draw, 0.08, 0.25));
  return [=](double x) { return slope * x + bend * std::abs(x); };
}

inline Shape wavy_spring(Draw& draw) {
  const Shape base = stiffening(draw);
  const double order = uniform(draw, 6.0, 14.0);
  const double phase = uniform(draw, 0.0, 2.0 * std::numbers::pi);
  const double size = uniform(draw, 0.1, 0.3) / order;
  return [=](double x) { return base(x) + size * (std::sin(order * x + phase) - std::sin(phase)); };
}

inline double bump(double x, double at, double width) {
  return std::exp(-0.5 * (x - at) * (x - at) / (width * width));
}

inline Shape bumped_spring(Draw& draw) {
  const Shape base = stiffening(draw);
  const double at = uniform(draw, -0.7, 0.7);
  const double width = uniform(draw, 0.1, 0.2);
  const double size = either(draw, uniform(draw, 0.02, 0.04));
  return [=](double x) { return base(x) + size * (bump(x, at, width) - bump(0.0, at, width)); };
}

// ---- g^-1

inline Shape saturating_damper(Draw& draw) {
  const double width = uniform(draw, 0.2, 0.8);
  const double linear = uniform(draw, 0.1, 0.25);
  const double size = uniform(draw, 0.1, 0.3);
  return
      [=](double z) { return linear * z + size * std::asinh(z / width) / std::asinh(1.0 / width); };
}

inline Shape quadratic_damper(Draw& draw) {
  const double linear = uniform(draw, 0.03, 0.1);
  const double size = uniform(draw, 0.25, 0.4);
  const double width = uniform(draw, 0.2, 0.5);
  return [=](double z) { return linear * z + size * z * (std::hypot(z, width) - width); };
}

inline Shape asymmetric_damper(Draw& draw) {
  const Shape base = draw() & 1U ? saturating_damper(draw) : quadratic_damper(draw);
  const double share = either(draw, uniform(draw, 0.08, 0.25));
  return [=](double z) { return base(z) * (1.0 + share * std::tanh(2.0 * z)); };
}

inline Shape kinked_damper(Draw& draw) {
  const double inner = uniform(draw, 0.15, 0.3);
  const double high = uniform(draw, 0.2, 0.7);
  const double low = uniform(draw, 0.2, 0.7);
  const double up = uniform(draw, 0.2, 0.5);
  const double down = uniform(draw, 0.2, 0.5);
  return [=](double z) {
    return inner * z + up * std::max(z - high, 0.0) + down * std::min(z + low, 0.0);
  };
}

inline Shape coulomb_damper(Draw& draw) {
  const Shape base = draw() & 1U ? saturating_damper(draw) : quadratic_damper(draw);
  const double jump = uniform(draw, 0.05, 0.2);
  return [=](double z) { return 0.7 * base(z) + (z > 0.0 ? jump : z < 0.0 ? -jump : 0.0); };
}

inline Shape steep_damper(Draw& draw) {
  const double width = std::exp(uniform(draw, std::log(0.01), std::log(0.06)));
  const double jump = uniform(draw, 0.05, 0.2);
  const double linear = uniform(draw, 0.15, 0.3);
  return [=](double z) { return linear * z + jump * std::tanh(z / width); };
}

inline Shape bumped_damper(Draw& draw) {
  const Shape base = saturating_damper(draw);
  const double at = either(draw, uniform(draw, 0.35, 0.75));
  const double width = uniform(draw, 0.1, 0.2);
  const double size = uniform(draw, 0.01, 0.025);
  return [=](double z) { return base(z) + size * (bump(z, at, width) - bump(0.0, at, width)); };
}

// ---- ln h

inline Shape unity(Draw&) {
  return [](double) { return 0.0; };
}

inline Shape even_modulation(Draw& draw) {
  const double size = either(draw, uniform(draw, 0.1, 0.3));
  const double order = uniform(draw, 1.0, 2.5);
  return [=](double x) { return size * (1.0 - std::cos(order * x)); };
}

inline Shape skewed_modulation(Draw& draw) {
  const double even = either(draw, uniform(draw, 0.05, 0.25));
  const double odd = either(draw, uniform(draw, 0.05, 0.2));
  const double order = uniform(draw, 1.0, 2.0);
  return [=](double x) { return even * (1.0 - std::cos(order * x)) + odd * std::sin(order * x); };
}

inline Shape kinked_modulation(Draw& draw) {
  const double size = either(draw, uniform(draw, 0.1, 0.4));
  const double tilt = either(draw, uniform(draw, 0.0, 0.1));
  return [=](double x) { return size * std::abs(x) + tilt * x; };
}

inline Shape wavy_modulation(Draw& draw) {
  const double order = uniform(draw, 4.0, 9.0);
  const double phase = uniform(draw, 0.0, 2.0 * std::numbers::pi);
  const double size = uniform(draw, 0.05, 0.15);
  return [=](double x) { return size * (std::sin(order * x + phase) - std::sin(phase)); };
}

inline Shape bumped_modulation(Draw& draw) {
  const double at = uniform(draw, -0.6, 0.6);
  const double width = uniform(draw, 0.15, 0.3);
  const double size = either(draw, uniform(draw, 0.1, 0.25));
  return [=](double x) { return size * (bump(x, at, width) - bump(0.0, at, width)); };
}

/// A family of gears; `smooth` ones have three derivatives.
struct GearFamily {
  std::string_view name;
  bool smooth;
  Shape (*f)(Draw&);
  Shape (*g_inverse)(Draw&);
  Shape (*log_h)(Draw&);
};

inline constexpr std::array kGearFamilies = {
    GearFamily{"smooth, h = 1", true, stiffening, saturating_damper, unity},
    GearFamily{"smooth, h even", true, stiffening, quadratic_damper, even_modulation},
    GearFamily{"smooth, nothing symmetric", true, asymmetric_spring, asymmetric_damper,
               skewed_modulation},
    GearFamily{"f kinked, h = 1", false, kinked_spring, saturating_damper, unity},
    GearFamily{"f kinked", false, kinked_spring, quadratic_damper, skewed_modulation},
    GearFamily{"f with |x|", false, bent_spring, asymmetric_damper, even_modulation},
    GearFamily{"f with a wave", false, wavy_spring, saturating_damper, even_modulation},
    GearFamily{"f with a bump", false, bumped_spring, quadratic_damper, skewed_modulation},
    GearFamily{"g^-1 kinked", false, asymmetric_spring, kinked_damper, even_modulation},
    GearFamily{"g^-1 jumps", false, stiffening, coulomb_damper, even_modulation},
    GearFamily{"g^-1 steep at zero", false, asymmetric_spring, steep_damper, skewed_modulation},
    GearFamily{"g^-1 with a bump", false, stiffening, bumped_damper, skewed_modulation},
    GearFamily{"h with |x|", false, stiffening, quadratic_damper, kinked_modulation},
    GearFamily{"h with a wave", false, asymmetric_spring, saturating_damper, wavy_modulation},
    GearFamily{"h with a bump", false, stiffening, asymmetric_damper, bumped_modulation},
    GearFamily{"all rough", false, kinked_spring, coulomb_damper, bumped_modulation},
};

/// Of which the first have an f or g^-1 of their own, and the rest an h.
inline constexpr std::size_t kFamiliesOfTorque = 12;

inline DrawnGear drawn_gear(const GearFamily& family, Draw& draw) {
  DrawnGear gear;
  gear.f = family.f(draw);
  gear.g_inverse = family.g_inverse(draw);
  gear.log_h = family.log_h(draw);
  return gear;
}

}  // namespace flexspline::estimators
