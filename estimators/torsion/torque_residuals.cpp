#include "torsion/torque_residuals.hpp"

#include <algorithm>

namespace flexspline::estimators {

Result<void> TorqueResiduals::evaluate(std::size_t block, std::span<const double> p,
                                       std::span<double> residual,
                                       std::span<double> jacobian) const {
  const auto f = make_law(layout_.f(p));
  const auto g_inverse = make_law(layout_.g_inverse(p));
  const auto h = make_law(layout_.h(p));
  for (const auto* law : {&f, &g_inverse, &h}) {
    if (!*law) return tl::unexpected((*law).error());
  }
  const PreparedRecord& one = records_[block];
  const double inertia = layout_.inertia(p);
  const double delay = layout_.delay(p);
  const double zero = layout_.zero(block, p);
  std::vector<double> h_gradient(layout_.h_group.count);

  for (std::size_t r = 0; r < one.rows.size(); ++r) {
    const double t = one.record.time[one.rows[r]] - delay;
    const double x = one.position.value(t) - zero;
    const double v = one.velocity.value(t);
    const double a = one.acceleration.value(t);
    const double modulation = (*h)->value(x);
    const double w = v / modulation;
    const double weight = 1.0 / one.effort_sigma[r];
    const double simulated =
        (*f)->value(x) + (*g_inverse)->value(w) + inertia * a + layout_.offset(p);
    residual[r] = (simulated - one.record.effort[one.rows[r]]) * weight;
    if (jacobian.empty()) continue;

    const auto row = jacobian.subspan(r * layout_.size(), layout_.size());
    std::ranges::fill(row, 0.0);
    const double along_speed = (*g_inverse)->slope(w);
    const double h_slope = (*h)->slope(x);
    const double along_motion = (*f)->slope(x) - along_speed * w * h_slope / modulation;
    (*f)->gradient(x, layout_.f_group.of(row));
    (*g_inverse)->gradient(w, layout_.g_group.of(row));
    if (layout_.h_group.present()) {
      (*h)->gradient(x, h_gradient);
      const auto part = layout_.h_group.of(row);
      for (std::size_t k = 0; k < part.size(); ++k) {
        part[k] = -along_speed * w / modulation * h_gradient[k];
      }
    }
    if (layout_.inertia_group.present()) row[layout_.inertia_group.first] = a;
    if (layout_.delay_group.present()) {
      row[layout_.delay_group.first] = -(along_motion * v + along_speed * a / modulation +
                                         inertia * one.acceleration.slope(t));
    }
    if (layout_.offset_group.present()) row[layout_.offset_group.first] = 1.0;
    if (layout_.zero_group.present()) row[layout_.zero_group.first + block] = -along_motion;
    for (double& entry : row) entry *= weight;
  }
  return {};
}

Result<std::vector<double>> TorqueResiduals::motion_slope(std::size_t block,
                                                          std::span<const double> p) const {
  const auto f = make_law(layout_.f(p));
  const auto g_inverse = make_law(layout_.g_inverse(p));
  const auto h = make_law(layout_.h(p));
  for (const auto* law : {&f, &g_inverse, &h}) {
    if (!*law) return tl::unexpected((*law).error());
  }
  const PreparedRecord& one = records_[block];
  std::vector<double> slopes;
  for (std::size_t row : one.rows) {
    const double x = one.smooth.motion.position[row] - layout_.zero(block, p);
    const double modulation = (*h)->value(x);
    const double w = one.smooth.motion.velocity[row] / modulation;
    slopes.push_back((*f)->slope(x) -
                     (*g_inverse)->slope(w) * w * (*h)->slope(x) / modulation);
  }
  return slopes;
}

}  // namespace flexspline::estimators
