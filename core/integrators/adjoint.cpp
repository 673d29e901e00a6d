#include <algorithm>
#include <cmath>

#include "flexspline/core/ode_system.hpp"
#include "integrators/backward_run.hpp"
#include "integrators/cvodes_run.hpp"
#include "integrators/system_duals.hpp"
#include "integrators/system_tolerances.hpp"

namespace flexspline {
namespace {

class Forward final : public CvodesProblem {
 public:
  explicit Forward(SystemDuals& duals) : duals_(duals) {}
  std::size_t rows() const override { return duals_.states(); }
  void rate(double t, const double* y, double* ydot) override { duals_.rate(t, y, ydot); }
  void jacobian(double t, const double* y, Eigen::Map<Eigen::MatrixXd> out) override {
    duals_.jacobian(t, y, out);
  }

 private:
  SystemDuals& duals_;
};

bool weighs(std::span<const double> row) {
  return std::ranges::any_of(row, [](double w) { return w != 0.0; });
}

// A state off by its absolute tolerance is to count in the sum like lambda off by its own.
CvodesAccuracy accuracy_of_lambda(const SystemSettings& settings, std::size_t states,
                                  std::span<const double> weight) {
  CvodesAccuracy accuracy{settings.relative_tolerance, state_tolerances(settings, states),
                          settings.max_steps};
  double largest = 0.0;
  for (std::size_t k = 0; k < weight.size(); ++k) {
    largest = std::max(largest, std::abs(weight[k]) * accuracy.absolute[k % states]);
  }
  for (double& a : accuracy.absolute) a = settings.relative_tolerance * largest / a;
  return accuracy;
}

std::vector<double> tolerances_of_gradient(const CvodesAccuracy& lambda,
                                           const SystemSettings& settings,
                                           std::span<const double> p) {
  const double state = state_tolerances(settings, lambda.absolute.size()).front();
  const double sum = lambda.absolute.front() * state / settings.relative_tolerance;
  std::vector<double> tolerances;
  for (const double value : p) tolerances.push_back(sum / parameter_scale(value));
  return tolerances;
}

// What one descent of lambda from the last instant with a weight to the first gives.
struct Descent {
  std::vector<double> lambda;
  std::vector<double> gradient;
};

Result<Descent> descend(CvodesRun& forward, SystemDuals& duals, std::span<const double> times,
                        std::span<const double> weight, const SystemSettings& settings,
                        std::span<const double> p) {
  const std::size_t n = duals.states();
  const auto row = [&](std::size_t k) { return weight.subspan(n * k, n); };
  if (const int flag = forward.record(times.back()); flag < 0) {
    return tl::unexpected(forward.error(flag));
  }
  Backward back(forward, duals, settings.stepping);
  const auto accuracy = accuracy_of_lambda(settings, n, weight.first(n * times.size()));
  back.start(times.back(), row(times.size() - 1), accuracy,
             tolerances_of_gradient(accuracy, settings, p));
  for (std::size_t k = times.size() - 1; k-- > 0;) {
    if (k > 0 && !weighs(row(k))) continue;
    if (const int flag = back.advance(times[k]); flag < 0) {
      return tl::unexpected(in_context(stopped(times[k], back.lambda(), flag), "adjoint"));
    }
    if (k > 0) back.jump(times[k], row(k));
  }
  const auto lambda = back.lambda();
  const auto gradient = back.quadrature();
  return Descent{{lambda.begin(), lambda.end()}, {gradient.begin(), gradient.end()}};
}

}  // namespace

Result<std::vector<double>> adjoint_gradient(const OdeSystem& system, std::span<const double> p,
                                             std::span<const double> times,
                                             std::span<const double> initial,
                                             std::span<const double> initial_sensitivity,
                                             std::span<const double> weight,
                                             const SystemSettings& settings) {
  const std::size_t n = system.states();
  expects(!times.empty() && weight.size() == n * times.size(), "one weight an instant and state");
  expects(initial_sensitivity.empty() || initial_sensitivity.size() == n * p.size(),
          "one initial sensitivity a state and parameter, or none");
  std::size_t last = times.size() - 1;
  while (last > 0 && !weighs(weight.subspan(n * last, n))) --last;
  Descent sum{std::vector(n, 0.0), std::vector(p.size(), 0.0)};
  if (last > 0 && !p.empty()) {
    SystemDuals duals(system, p);
    Forward problem(duals);
    CvodesRun forward(
        problem, settings.stepping, times.front(), initial,
        {settings.relative_tolerance, state_tolerances(settings, n), settings.max_steps});
    auto made = descend(forward, duals, times.first(last + 1), weight, settings, p);
    if (!made) return tl::unexpected(made.error());
    sum = std::move(*made);
  }
  for (std::size_t k = 0; k < initial_sensitivity.size(); ++k) {
    const std::size_t i = k / p.size();
    sum.gradient[k % p.size()] += (sum.lambda[i] + weight[i]) * initial_sensitivity[k];
  }
  return std::move(sum.gradient);
}

}  // namespace flexspline
