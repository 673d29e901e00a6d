#include <algorithm>
#include <cmath>

#include "flexspline/core/ode_system.hpp"
#include "integrators/cvodes_run.hpp"
#include "integrators/system_duals.hpp"
#include "integrators/system_tolerances.hpp"

namespace flexspline {
namespace {

// The states, and beside them in columns their sensitivities if they are asked for.
class Sensitive final : public CvodesProblem {
 public:
  Sensitive(const OdeSystem& system, std::span<const double> p, std::size_t directions)
      : duals_(system, p), directions_(directions) {}
  std::size_t rows() const override { return duals_.states(); }
  std::size_t columns() const override { return 1 + directions_; }
  void rate(double t, const double* z, double* zdot) override {
    if (directions_ == 0) return duals_.rate(t, z, zdot);
    duals_.sensitivity_rate(t, z, zdot);
  }
  void jacobian(double t, const double* z, Eigen::Map<Eigen::MatrixXd> out) override {
    duals_.jacobian(t, z, out);
  }

 private:
  SystemDuals duals_;
  std::size_t directions_;
};

// From columns to [state][parameter].
void append(SystemTrajectory& out, std::span<const double> z) {
  const std::size_t n = out.states;
  out.state.insert(out.state.end(), z.begin(), z.begin() + static_cast<std::ptrdiff_t>(n));
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = n + i; k < z.size(); k += n) out.sensitivity.push_back(z[k]);
  }
}

// The same the other way round, behind the states; zero where nothing is given.
std::vector<double> in_columns(std::span<const double> initial, std::span<const double> sensitivity,
                               std::size_t directions) {
  const std::size_t n = initial.size();
  expects(sensitivity.empty() || sensitivity.size() == n * directions,
          "one initial sensitivity a state and parameter, or none");
  std::vector<double> z(n * (1 + directions), 0.0);
  std::ranges::copy(initial, z.begin());
  for (std::size_t k = 0; k < sensitivity.size(); ++k) {
    z[n * (1 + k % directions) + k / directions] = sensitivity[k];
  }
  return z;
}

Result<SystemTrajectory> run(const OdeSystem& system, std::span<const double> p,
                             std::span<const double> times, std::span<const double> z,
                             std::size_t directions, const SystemSettings& settings) {
  expects(!times.empty(), "an instant at which the initial state holds");
  Sensitive problem(system, p, directions);
  CvodesRun cvodes(
      problem, settings.stepping, times.front(), z,
      {settings.relative_tolerance,
       column_tolerances(settings, system.states(), p.first(directions)), settings.max_steps});
  cvodes.stop_at(times.back());
  SystemTrajectory out;
  out.states = system.states();
  append(out, z);
  for (const double t : times.subspan(1)) {
    const int flag = cvodes.advance(t);
    if (flag < 0 || !all_finite(cvodes.values())) return tl::unexpected(cvodes.error(flag));
    append(out, cvodes.values());
  }
  out.steps = cvodes.steps();
  out.evaluations = cvodes.evaluations();
  return out;
}

}  // namespace

std::vector<double> state_tolerances(const SystemSettings& settings, std::size_t states) {
  if (settings.absolute_tolerance.empty()) return std::vector(states, settings.relative_tolerance);
  expects(settings.absolute_tolerance.size() == states, "one absolute tolerance a state");
  return settings.absolute_tolerance;
}

std::vector<double> column_tolerances(const SystemSettings& settings, std::size_t states,
                                      std::span<const double> p) {
  const auto state = state_tolerances(settings, states);
  std::vector<double> all = state;
  for (const double value : p) {
    for (const double tolerance : state) all.push_back(tolerance / parameter_scale(value));
  }
  return all;
}

double parameter_scale(double value) { return value == 0.0 ? 1.0 : std::abs(value); }

Result<SystemTrajectory> integrate_system(const OdeSystem& system, std::span<const double> p,
                                          std::span<const double> times,
                                          std::span<const double> initial,
                                          const SystemSettings& settings) {
  return run(system, p, times, initial, 0, settings);
}

Result<SystemTrajectory> integrate_with_sensitivities(const OdeSystem& system,
                                                      std::span<const double> p,
                                                      std::span<const double> times,
                                                      std::span<const double> initial,
                                                      std::span<const double> initial_sensitivity,
                                                      const SystemSettings& settings) {
  return run(system, p, times, in_columns(initial, initial_sensitivity, p.size()), p.size(),
             settings);
}

}  // namespace flexspline
