#include "bench/hidden_gear.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "bench/hidden_draw.hpp"

namespace flexspline::data {
namespace {

using Curve = double (*)(double x, double bend);

struct Family {
  const char* name;
  double low;  ///< range of the bend
  double high;
  Curve curve;
};

// Odd and rising in x = phi / rated torsion.
constexpr std::array<Family, 3> kStiffness = {{
    {"sinh(b x)", 0.8, 1.8, [](double x, double b) { return std::sinh(b * x); }},
    {"x + b x^3/(1 + x^2)", 0.8, 2.5,
     [](double x, double b) { return x + b * x * x * x / (1.0 + x * x); }},
    {"x sqrt(1 + b x^2)", 0.8, 3.0,
     [](double x, double b) { return x * std::sqrt(1.0 + b * x * x); }},
}};

// Odd and rising in y = speed / the design's middle speed.
constexpr std::array<Family, 3> kDamping = {{
    {"asinh(b y)", 1.0, 3.0, [](double y, double b) { return std::asinh(b * y); }},
    {"y (1 + y^2)^((b - 1)/2)", 0.3, 0.6,
     [](double y, double b) { return y * std::pow(1.0 + y * y, 0.5 * (b - 1.0)); }},
    {"y/(1 + y^2)^(1/2) + b y", 0.02, 0.08,
     [](double y, double b) { return y / std::sqrt(1.0 + y * y) + b * y; }},
}};

// Even and between 1 and 1 + b.
constexpr std::array<Family, 2> kModulation = {{
    {"1 + b x^2/(1 + x^2)", 0.1, 0.6,
     [](double x, double b) { return 1.0 + b * x * x / (1.0 + x * x); }},
    {"1 + b (1 - exp(-x^2))", 0.1, 0.4,
     [](double x, double b) { return 1.0 - b * std::expm1(-x * x); }},
}};

struct Drawn {
  const Family* family;
  double bend;

  double operator()(double x) const { return family->curve(x, bend); }
  std::string text() const { return fmt::format("{} with b = {:.4g}", family->name, bend); }
};

template <std::size_t n>
Drawn draw_family(const std::array<Family, n>& families, std::uint64_t seed, const char* role) {
  const double place = drawn(seed, role, 0, 0.0, static_cast<double>(n));
  const Family& family = families[std::min(n - 1, static_cast<std::size_t>(place))];
  return {&family, drawn(seed, role, 1, family.low, family.high)};
}

void draw_motor(HiddenGear& gear, std::uint64_t seed, double motor_speed) {
  const auto about = [seed](std::uint64_t index, double nominal) {
    return nominal * drawn(seed, "motor", index, 0.8, 1.2);
  };
  gear.motor_inertia = about(0, 7.26e-4);
  gear.motor_drag = about(1, 6e-4);
  gear.motor_coulomb = about(2, 0.05);
  gear.motor_coulomb_speed = about(3, 0.08 * motor_speed);
}

}  // namespace

HiddenGear draw_gear(Rig rig, std::uint64_t seed, double rated_torque, double rated_torsion,
                     double speed) {
  const Drawn f = draw_family(kStiffness, seed, "f");
  const Drawn g = draw_family(kDamping, seed, "g");
  const Drawn h = draw_family(kModulation, seed, "h");
  const double loss = drawn(seed, "g", 2, 0.05, 0.12) * rated_torque / g(10.0);
  HiddenGear gear;
  gear.families = fmt::format("f {}; g^-1 {}; h {}", f.text(), g.text(), h.text());
  gear.rated_torsion = rated_torsion;
  gear.rated_torque = rated_torque;
  gear.stiffness = [=](double phi) { return rated_torque * f(phi / rated_torsion) / f(1.0); };
  gear.damping = [=](double rate) { return loss * g(rate / speed); };
  gear.modulation = [=](double phi) { return h(phi / rated_torsion); };
  if (rig == Rig::specimen) {
    gear.gear_ratio = 1.0;
    return gear;
  }
  const bool locked = rig == Rig::locked;
  draw_motor(gear, seed, locked ? gear.gear_ratio * speed : 20.0);
  if (rig == Rig::free) gear.load_inertia = drawn(seed, "load", 0, 2.2, 3.6);
  if (!locked) gear.load_drag = drawn(seed, "load", 1, 0.4, 1.2);
  if (rig == Rig::servo) {
    gear.arm_length = drawn(seed, "load", 2, 0.25, 0.5);
    gear.load_mass = rated_torque / (9.81 * gear.arm_length);
    gear.load_inertia = gear.load_mass * gear.arm_length * gear.arm_length;
  }
  return gear;
}

}  // namespace flexspline::data
