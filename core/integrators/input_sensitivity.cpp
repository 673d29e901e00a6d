#include <algorithm>

#include "flexspline/core/monotone_input.hpp"
#include "integrators/cvodes_run.hpp"
#include "integrators/system_duals.hpp"
#include "integrators/system_tolerances.hpp"

namespace flexspline {
namespace {

// z = (y, P / (deviation^2 interval)): the states, then their covariance by columns for an input of
// unit intensity.
class Covariance final : public CvodesProblem {
 public:
  Covariance(const OdeSystem& system, std::span<const double> p, std::size_t input)
      : duals_(system, p),
        input_(static_cast<Eigen::Index>(input)),
        fy_(states(), states()),
        fp_(states(), static_cast<Eigen::Index>(p.size())) {}

  std::size_t rows() const override { return duals_.states() * (1 + duals_.states()); }

  void rate(double t, const double* z, double* zdot) override {
    const Eigen::Index n = states();
    duals_.rate(t, z, zdot);
    duals_.jacobian(t, z, {fy_.data(), n, n});
    duals_.parameter_jacobian(t, z, {fp_.data(), n, fp_.cols()});
    const Eigen::Map<const Eigen::MatrixXd> covariance(z + n, n, n);
    Eigen::Map<Eigen::MatrixXd> out(zdot + n, n, n);
    out = fy_ * covariance + covariance * fy_.transpose() +
          fp_.col(input_) * fp_.col(input_).transpose();
  }

  // fy on the states, and on column j of P: fy P_j + sum_k fy(j, k) P_k.
  void jacobian(double t, const double* z, Eigen::Map<Eigen::MatrixXd> out) override {
    const Eigen::Index n = states();
    duals_.jacobian(t, z, {fy_.data(), n, n});
    out.setZero();
    out.topLeftCorner(n, n) = fy_;
    for (Eigen::Index j = 0; j < n; ++j) {
      out.block(n * (1 + j), n * (1 + j), n, n) = fy_;
      for (Eigen::Index k = 0; k < n; ++k) {
        out.block(n * (1 + j), n * (1 + k), n, n).diagonal().array() += fy_(j, k);
      }
    }
  }

 private:
  Eigen::Index states() const { return static_cast<Eigen::Index>(duals_.states()); }

  SystemDuals duals_;
  Eigen::Index input_;
  Eigen::MatrixXd fy_;
  Eigen::MatrixXd fp_;
};

}  // namespace

Result<std::vector<double>> input_sensitivity(const OdeSystem& system, std::span<const double> p,
                                              std::size_t input, const InputNoise& noise,
                                              std::span<const double> times,
                                              std::span<const double> initial,
                                              const SystemSettings& settings) {
  const std::size_t n = system.states();
  expects(!times.empty() && input < p.size() && initial.size() == n,
          "instants, an initial state, and a parameter that the input's error adds to");
  std::vector<double> z(n * (1 + n), 0.0);
  std::ranges::copy(initial, z.begin());
  std::vector<double> tolerance = state_tolerances(settings, n);
  for (std::size_t k = 0; k < n * n; ++k) tolerance.push_back(tolerance[k / n] * tolerance[k % n]);
  Covariance problem(system, p, input);
  CvodesRun run(problem, settings.stepping, times.front(), z,
                {settings.relative_tolerance, tolerance, settings.max_steps});
  run.stop_at(times.back());
  const double intensity = noise.deviation * noise.deviation * noise.interval;
  std::vector<double> variance(n, 0.0);
  for (const double t : times.subspan(1)) {
    const int flag = run.advance(t);
    if (flag < 0 || !all_finite(run.values())) return tl::unexpected(run.error(flag));
    for (std::size_t i = 0; i < n; ++i) {
      variance.push_back(intensity * run.values()[n + i * (n + 1)]);
    }
  }
  return variance;
}

}  // namespace flexspline
