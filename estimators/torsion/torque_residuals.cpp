#include "torsion/torque_residuals.hpp"

#include <algorithm>
#include <memory>

namespace flexspline::estimators {
namespace {

/// phi, phi', phi'' at one instant, phi from the record's zero.
struct Instant {
  double time, position, velocity, acceleration;
};

Instant instant_at(const PreparedRecord& one, double t, double zero) {
  return {t, one.position.value(t) - zero, one.velocity.value(t), one.acceleration.value(t)};
}

/// Eq. (4) with inertia, delay and offset at one p.
struct TorqueLaw {
  std::unique_ptr<Law> f;
  std::unique_ptr<Law> g_inverse;
  std::unique_ptr<Law> h;
  double inertia = 0.0;
  double delay = 0.0;
  double offset = 0.0;

  double speed(const Instant& at) const { return at.velocity / h->value(at.position); }

  double torque(const Instant& at) const {
    return f->value(at.position) + g_inverse->value(speed(at)) + inertia * at.acceleration + offset;
  }

  // d tau / d phi at a fixed phi'.
  double along_motion(const Instant& at) const {
    const double w = speed(at);
    return f->slope(at.position) -
           g_inverse->slope(w) * w * h->slope(at.position) / h->value(at.position);
  }
};

Result<TorqueLaw> law_at(const TorsionLayout& layout, std::span<const double> p) {
  auto f = make_law(layout.f(p));
  auto g_inverse = make_law(layout.g_inverse(p));
  auto h = make_law(layout.h(p));
  for (const auto* law : {&f, &g_inverse, &h}) {
    if (!*law) return tl::unexpected(law->error());
  }
  return TorqueLaw{std::move(*f),     std::move(*g_inverse), std::move(*h),
                   layout.inertia(p), layout.delay(p),       layout.offset(p)};
}

// d tau / d p at one instant of a record. The delay moves along the motion, whose jerk is that of
// the spline through its acceleration.
void fill_gradient(const TorsionLayout& layout, const TorqueLaw& law, const Instant& at,
                   double jerk, std::size_t block, std::span<double> row) {
  std::ranges::fill(row, 0.0);
  const double w = law.speed(at);
  const double modulation = law.h->value(at.position);
  const double along_speed = law.g_inverse->slope(w);
  const double along_motion = law.along_motion(at);
  law.f->gradient(at.position, layout.f_group.of(row));
  law.g_inverse->gradient(w, layout.g_group.of(row));
  if (layout.h_group.present()) {
    const auto part = layout.h_group.of(row);
    law.h->gradient(at.position, part);
    for (double& entry : part) entry *= -along_speed * w / modulation;
  }
  if (layout.inertia_group.present()) row[layout.inertia_group.first] = at.acceleration;
  if (layout.delay_group.present()) {
    row[layout.delay_group.first] =
        -(along_motion * at.velocity + along_speed * at.acceleration / modulation +
          law.inertia * jerk);
  }
  if (layout.offset_group.present()) row[layout.offset_group.first] = 1.0;
  if (layout.zero_group.present()) row[layout.zero_group.first + block] = -along_motion;
}

}  // namespace

Result<void> TorqueResiduals::evaluate(std::size_t block, std::span<const double> p,
                                       std::span<double> residual,
                                       std::span<double> jacobian) const {
  const auto law = law_at(layout_, p);
  if (!law) return tl::unexpected(law.error());
  const PreparedRecord& one = records_[block];
  const double zero = layout_.zero(block, p);
  for (std::size_t r = 0; r < one.rows.size(); ++r) {
    const std::size_t sample = one.rows[r];
    const Instant at = instant_at(one, one.record.time[sample] - law->delay, zero);
    const double weight = 1.0 / one.effort_sigma[r];
    residual[r] = (law->torque(at) - one.record.effort[sample]) * weight;
    if (jacobian.empty()) continue;
    const auto row = jacobian.subspan(r * layout_.size(), layout_.size());
    fill_gradient(layout_, *law, at, one.acceleration.slope(at.time), block, row);
    for (double& entry : row) entry *= weight;
  }
  return {};
}

Result<std::vector<double>> TorqueResiduals::motion_slope(std::size_t block,
                                                          std::span<const double> p) const {
  const auto law = law_at(layout_, p);
  if (!law) return tl::unexpected(law.error());
  const PreparedRecord& one = records_[block];
  const auto& motion = one.smooth.motion;
  std::vector<double> slopes;
  for (std::size_t row : one.rows) {
    slopes.push_back(
        law->along_motion({motion.time[row], motion.position[row] - layout_.zero(block, p),
                           motion.velocity[row], motion.acceleration[row]}));
  }
  return slopes;
}

}  // namespace flexspline::estimators
