#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "flexspline/core/stick_slip.hpp"
#include "integrators/dry_friction.hpp"

namespace flexspline {
namespace {

class Smoothed final : public CvodesProblem {
 public:
  Smoothed(const DryFrictionDrive& drive, double width) : drive_(drive), width_(width) {}
  std::size_t rows() const override { return 2; }
  void rate(double t, const double* z, double* zdot) override {
    zdot[0] = z[1];
    zdot[1] =
        (drive_.effort(t, z[0]) - drive_.viscous * z[1] - std::tanh(z[1] / width_) * level(z[1])) /
        drive_.inertia;
  }
  void jacobian(double t, const double* z, Eigen::Map<Eigen::MatrixXd> out) override {
    const double sign = std::tanh(z[1] / width_);
    fill_jacobian(
        drive_, t, z[0],
        (1.0 - sign * sign) / width_ * level(z[1]) + sign * slip_level_slope(drive_, z[1]), out);
  }

 private:
  // Without a Stribeck speed friction falls within some widths, or it would never show Fs.
  double level(double v) const {
    if (drive_.stribeck_speed > 0.0) return slip_level(drive_, v);
    const double u = v / (10.0 * width_);
    return drive_.sliding_level + (drive_.static_level - drive_.sliding_level) * std::exp(-u * u);
  }

  const DryFrictionDrive& drive_;
  double width_;
};

double largest(std::span<const double> x) {
  double most = 0.0;
  for (const double value : x) most = std::max(most, std::abs(value));
  return most;
}

double relative_distance(std::span<const double> x, std::span<const double> exact) {
  double most = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) most = std::max(most, std::abs(x[i] - exact[i]));
  return most / largest(exact);
}

}  // namespace

Result<SmoothedTrajectory> simulate_smoothed(const DryFrictionDrive& drive, double width,
                                             std::span<const double> times, double position,
                                             double speed, const StickSlipSettings& settings) {
  const auto exact = simulate_stick_slip(drive, times, position, speed, settings);
  if (!exact) return tl::unexpected(exact.error());
  if (!(width > 0.0)) {
    return failure(ErrorCode::bad_data, fmt::format("width = {:.6g} of a smoothed sign", width),
                   "it has to be positive");
  }
  Smoothed problem(drive, width);
  CvodesRun run(problem, Stepping::bdf, times.front(), std::array{position, speed},
                accuracy_of(settings));
  run.stop_at(times.back());
  SmoothedTrajectory out;
  for (const double t : times) {
    const int flag = t > run.reached() ? run.advance(t) : 0;
    if (flag < 0 || !all_finite(run.values())) return tl::unexpected(run.error(flag));
    out.position.push_back(run.values()[0]);
    out.speed.push_back(run.values()[1]);
  }
  out.error = relative_distance(out.position, exact->position);
  out.steps = run.steps();
  return out;
}

}  // namespace flexspline
