#include <algorithm>
#include <cmath>

#include "flexspline/core/forward_sensitivity.hpp"
#include "flexspline/core/law.hpp"
#include "flexspline/core/monotone_spline.hpp"
#include "flexspline/core/spline.hpp"
#include "flexspline/core/torque_signal.hpp"

namespace flexspline {
namespace {

// x = phi / scale of f: x' = h g(tau - f(phi)) / scale.
class TorqueDriven final : public ScalarOde {
 public:
  TorqueDriven(const Law& f, const Law& g_inverse, const Law& h, const Spline& torque)
      : f_(f), g_inverse_(g_inverse), h_(h), torque_(torque), scale_(f.spec().scale) {}

  std::size_t parameters() const override { return 0; }

  double rate(double t, double x) const override {
    const double phi = x * scale_;
    return h_.value(phi) * inverse(torque_.value(t) - f_.value(phi)) / scale_;
  }

  double jacobian(double t, double x) const override {
    const double phi = x * scale_;
    const double v = inverse(torque_.value(t) - f_.value(phi));
    return h_.slope(phi) * v - h_.value(phi) * f_.slope(phi) / g_inverse_.slope(v);
  }

  double parameter_derivative(double t, double x, std::span<double>) const override {
    return jacobian(t, x);
  }

 private:
  // g by Newton within a bracket that grows until it holds the root: laws without a closed inverse.
  double inverse(double y) const {
    if (const auto* spline = dynamic_cast<const MonotoneSpline*>(&g_inverse_)) {
      return spline->inverse(y);
    }
    double low = -g_inverse_.spec().scale;
    double high = -low;
    while (g_inverse_.value(low) > y && std::isfinite(low)) low *= 2.0;
    while (g_inverse_.value(high) < y && std::isfinite(high)) high *= 2.0;
    double v = 0.0;
    for (int k = 0; k < 200 && std::isfinite(low) && std::isfinite(high); ++k) {
      const double error = g_inverse_.value(v) - y;
      (error > 0.0 ? high : low) = v;
      double next = v - error / g_inverse_.slope(v);
      if (!(next > low && next < high)) next = 0.5 * (low + high);
      if (std::abs(next - v) <= 1e-15 * std::max(high - low, std::abs(v))) return next;
      v = next;
    }
    return std::isfinite(low) && std::isfinite(high) ? v : std::nan("");
  }

  const Law& f_;
  const Law& g_inverse_;
  const Law& h_;
  const Spline& torque_;
  double scale_;
};

}  // namespace

Result<std::vector<double>> simulate_torsion(const ModelSpec& model, std::span<const double> time,
                                             std::span<const double> torque, double initial,
                                             const IntegratorSettings& settings) {
  if (!model.effects.empty()) {
    return simulate_torsion(model, time, sampled_signal(time, torque), initial, settings);
  }
  const auto f = make_law(model.f);
  const auto g_inverse = make_law(model.g_inverse);
  const auto h = make_law(model.h);
  for (const auto* law : {&f, &g_inverse, &h}) {
    if (!*law) return tl::unexpected(law->error());
  }
  const Spline input(time, torque);
  const double scale = model.f.scale;
  const TorqueDriven ode(**f, **g_inverse, **h, input);
  auto trajectory = integrate(ode, time, initial / scale, {}, settings);
  if (!trajectory) return tl::unexpected(trajectory.error());
  for (double& x : trajectory->state) x *= scale;
  return std::move(trajectory->state);
}

}  // namespace flexspline
