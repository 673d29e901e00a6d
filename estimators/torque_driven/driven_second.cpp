#include "torque_driven/driven_second.hpp"

#include <array>
#include <cmath>

#include "flexspline/core/lane_kernels.hpp"

namespace flexspline::estimators {
namespace {

/// Value and derivatives of a polynomial with its powers, in powers x^(2k + lead).
struct Part {
  std::array<double, kMostLaneDirections> power{};
  std::array<double, kMostLaneDirections> power_slope{};
  double value = 0.0;
  double slope = 0.0;
  double bend = 0.0;
};

Part part_of(std::span<const double> c, int lead, double x) {
  Part part;
  double below = lead == 1 ? 1.0 : x;    // x^(2k + lead - 1)
  double under = lead == 1 ? 0.0 : 1.0;  // x^(2k + lead - 2)
  for (std::size_t k = 0; k < c.size(); ++k) {
    const double order = 2.0 * static_cast<double>(k) + lead;
    part.power[k] = below * x;
    part.power_slope[k] = order * below;
    part.value += c[k] * part.power[k];
    part.slope += c[k] * part.power_slope[k];
    part.bend += c[k] * order * (order - 1.0) * under;
    under = below * x;
    below = under * x;
  }
  return part;
}

}  // namespace

// F = h(x) g(u), u = torque - f(x), h = exp(e(x)).
void differentiate(const DrivenProblem& problem, std::span<const double> p, double torque, double x,
                   Derivatives order, DrivenDerivatives& out) {
  const auto nf = static_cast<std::size_t>(problem.f);
  const auto ng = static_cast<std::size_t>(problem.g);
  const auto nh = static_cast<std::size_t>(problem.h);
  const Part f = part_of(p.first(nf), 1, x);
  const Part g = part_of(p.subspan(nf, ng), 1, torque - f.value);
  const Part e = part_of(p.subspan(nf + ng), 2, x);
  const double h = std::exp(e.value);
  out.value = h * g.value;
  if (order == Derivatives::none) return;
  out.slope = h * (e.slope * g.value - g.slope * f.slope);
  out.gradient.resize(p.size());
  for (std::size_t k = 0; k < nf; ++k) out.gradient[k] = -h * g.slope * f.power[k];
  for (std::size_t k = 0; k < ng; ++k) out.gradient[nf + k] = h * g.power[k];
  for (std::size_t k = 0; k < nh; ++k) out.gradient[nf + ng + k] = out.value * e.power[k];
  if (order == Derivatives::first) return;
  out.bend = h * ((e.slope * e.slope + e.bend) * g.value - 2.0 * e.slope * g.slope * f.slope +
                  g.bend * f.slope * f.slope - g.slope * f.bend);
  out.mixed.resize(p.size());
  for (std::size_t k = 0; k < nf; ++k) {
    out.mixed[k] =
        -h * ((e.slope * g.slope - g.bend * f.slope) * f.power[k] + g.slope * f.power_slope[k]);
  }
  for (std::size_t k = 0; k < ng; ++k) {
    out.mixed[nf + k] = h * (e.slope * g.power[k] - g.power_slope[k] * f.slope);
  }
  for (std::size_t k = 0; k < nh; ++k) {
    out.mixed[nf + ng + k] = out.slope * e.power[k] + out.value * e.power_slope[k];
  }
  out.curvature.clear();
  for (std::size_t i = 0; i < nf; ++i) {
    for (std::size_t k = 0; k <= i; ++k) {
      out.curvature.push_back(h * g.bend * f.power[i] * f.power[k]);
    }
  }
  for (std::size_t i = 0; i < ng; ++i) {
    for (std::size_t k = 0; k < nf; ++k) {
      out.curvature.push_back(-h * g.power_slope[i] * f.power[k]);
    }
    out.curvature.insert(out.curvature.end(), i + 1, 0.0);
  }
  for (std::size_t i = 0; i < nh; ++i) {
    for (std::size_t k = 0; k < nf + ng; ++k) out.curvature.push_back(e.power[i] * out.gradient[k]);
    for (std::size_t k = 0; k <= i; ++k) {
      out.curvature.push_back(out.value * e.power[i] * e.power[k]);
    }
  }
}

}  // namespace flexspline::estimators
