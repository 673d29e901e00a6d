#include "torsion/torsion_residuals.hpp"

#include <algorithm>
#include <memory>

#include "flexspline/core/forward_sensitivity.hpp"
#include "flexspline/core/monotone_spline.hpp"

namespace flexspline::estimators {
namespace {

// The state is x = phi / scale, so that tolerances mean the same for every gear.
class TorqueDriven final : public ScalarOde {
 public:
  TorqueDriven(const TorsionLayout& layout, const PreparedRecord& record, std::span<const double> p,
               bool sensitive, const Law& f, const Law& h)
      : layout_(layout),
        record_(record),
        f_(f),
        h_(h),
        g_inverse_(layout.g_inverse(p)),
        inertia_(layout.inertia(p)),
        delay_(layout.delay(p)),
        offset_(layout.offset(p)),
        scale_(f.spec().scale),
        parameters_(sensitive ? layout.size() : 0) {}

  std::size_t parameters() const override { return parameters_; }

  double rate(double t, double x) const override {
    const double phi = x * scale_;
    return h_.value(phi) * speed(t, phi) / scale_;
  }

  double jacobian(double t, double x) const override {
    const double phi = x * scale_;
    const double v = speed(t, phi);
    return h_.slope(phi) * v - h_.value(phi) * f_.slope(phi) / g_inverse_.slope(v);
  }

  // dF/dtau in rad/s per Nm and dF/dphi in 1/s where the torsion moves at this rate.
  double gain(double x, double rate) const {
    const double modulation = h_.value(x * scale_);
    return modulation / g_inverse_.slope(rate / modulation);
  }
  double decay(double x, double rate) const {
    const double phi = x * scale_;
    return h_.slope(phi) * rate / h_.value(phi) - gain(x, rate) * f_.slope(phi);
  }

  double parameter_derivative(double t, double x, std::span<double> out) const override {
    const double phi = x * scale_;
    const double v = speed(t, phi);
    const double modulation = h_.value(phi);
    const double gain = modulation / g_inverse_.slope(v);
    std::ranges::fill(out, 0.0);
    f_.gradient(phi, layout_.f_group.of(out));
    g_inverse_.gradient(v, layout_.g_group.of(out));
    for (double& entry : out.first(layout_.g_group.first + layout_.g_group.count)) entry *= -gain;
    if (layout_.h_group.present()) {
      const auto part = layout_.h_group.of(out);
      h_.gradient(phi, part);
      for (double& entry : part) entry *= v;
    }
    if (layout_.inertia_group.present()) {
      out[layout_.inertia_group.first] = -gain * record_.acceleration.value(t);
    }
    if (layout_.delay_group.present()) {
      out[layout_.delay_group.first] = gain * record_.effort.slope(t + delay_);
    }
    if (layout_.offset_group.present()) out[layout_.offset_group.first] = -gain;
    for (double& entry : out) entry /= scale_;
    return h_.slope(phi) * v - gain * f_.slope(phi);
  }

 private:
  double speed(double t, double phi) const {
    double torque = record_.effort.value(t + delay_) - offset_;
    if (inertia_ != 0.0) torque -= inertia_ * record_.acceleration.value(t);
    return g_inverse_.inverse(torque - f_.value(phi));
  }

  const TorsionLayout& layout_;
  const PreparedRecord& record_;
  const Law& f_;
  const Law& h_;
  MonotoneSpline g_inverse_;
  double inertia_, delay_, offset_, scale_;
  std::size_t parameters_;
};

struct Laws {
  std::unique_ptr<Law> f;
  std::unique_ptr<Law> h;
};

Result<Laws> laws_at(const TorsionLayout& layout, std::span<const double> p) {
  auto f = make_law(layout.f(p));
  if (!f) return tl::unexpected(f.error());
  auto h = make_law(layout.h(p));
  if (!h) return tl::unexpected(h.error());
  return Laws{std::move(*f), std::move(*h)};
}

double initial_torsion(const TorsionLayout& layout, const PreparedRecord& record, std::size_t block,
                       std::span<const double> p) {
  return layout.initial_group.present() ? p[layout.initial_group.first + block]
                                        : record.position.value(record.record.time.front());
}

}  // namespace

Result<void> TorsionResiduals::evaluate(std::size_t block, std::span<const double> p,
                                        std::span<double> residual,
                                        std::span<double> jacobian) const {
  const PreparedRecord& one = records_[block];
  const auto laws = laws_at(layout_, p);
  if (!laws) return tl::unexpected(laws.error());
  const bool sensitive = !jacobian.empty();
  const TorqueDriven ode(layout_, one, p, sensitive, *laws->f, *laws->h);
  const double scale = laws->f->spec().scale;

  std::vector<double> start(ode.parameters(), 0.0);
  if (sensitive && layout_.initial_group.present()) {
    start[layout_.initial_group.first + block] = 1.0 / scale;
  }
  const double zero = layout_.zero(block, p);
  const double initial = (initial_torsion(layout_, one, block, p) - zero) / scale;
  if (sensitive && layout_.zero_group.present()) {
    start[layout_.zero_group.first + block] = -1.0 / scale;
  }
  const auto trajectory = integrate(ode, one.record.time, initial, start, settings_);
  if (!trajectory) return tl::unexpected(in_context(trajectory.error(), one.record.id));

  for (std::size_t r = 0; r < one.rows.size(); ++r) {
    const std::size_t i = one.rows[r];
    residual[r] = trajectory->state[i] * scale + zero - one.smooth.motion.position[i];
    if (!sensitive) continue;
    const auto row = jacobian.subspan(r * layout_.size(), layout_.size());
    for (std::size_t k = 0; k < layout_.size(); ++k) {
      row[k] = trajectory->sensitivity[i * layout_.size() + k] * scale;
    }
    if (layout_.zero_group.present()) row[layout_.zero_group.first + block] += 1.0;
  }
  filters_[block].whiten(residual, jacobian, layout_.size());
  return {};
}

Result<void> TorsionResiduals::weigh(std::span<const double> p) {
  filters_.clear();
  for (std::size_t block = 0; block < records_.size(); ++block) {
    const PreparedRecord& one = records_[block];
    const auto laws = laws_at(layout_, p);
    if (!laws) return tl::unexpected(laws.error());
    const TorqueDriven ode(layout_, one, p, false, *laws->f, *laws->h);
    // Along the measured motion, so that a start that is still off does not misplace the weights.
    std::vector<double> decay;
    std::vector<double> gain;
    for (std::size_t i = 0; i < one.record.time.size(); ++i) {
      const double x =
          (one.smooth.motion.position[i] - layout_.zero(block, p)) / laws->f->spec().scale;
      decay.push_back(ode.decay(x, one.smooth.motion.velocity[i]));
      gain.push_back(ode.gain(x, one.smooth.motion.velocity[i]));
    }
    filters_.emplace_back(one, decay, gain);
  }
  return {};
}

}  // namespace flexspline::estimators
