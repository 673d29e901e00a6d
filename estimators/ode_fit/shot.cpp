#include "ode_fit/shot.hpp"

#include <numeric>

namespace flexspline::estimators {
namespace {

// The system with its free starting values as parameters that the law does not know.
class WithStart final : public OdeSystem {
 public:
  WithStart(const OdeSystem& system, std::size_t extra) : system_(system), extra_(extra) {}
  std::size_t states() const override { return system_.states(); }
  std::size_t parameters() const override { return system_.parameters() + extra_; }
  void rate(double t, std::span<const double> y, std::span<const double> p,
            std::span<double> ydot) const override {
    system_.rate(t, y, p.first(system_.parameters()), ydot);
  }
  void rate(double t, std::span<const Dual> y, std::span<const Dual> p,
            std::span<Dual> ydot) const override {
    system_.rate(t, y, p.first(system_.parameters()), ydot);
  }

 private:
  const OdeSystem& system_;
  std::size_t extra_;
};

std::vector<double> unit_sensitivity(std::span<const Source> start, std::size_t parameters,
                                     std::size_t directions) {
  std::vector<double> sensitivity(start.size() * directions, 0.0);
  std::size_t direction = parameters;
  for (std::size_t i = 0; i < start.size(); ++i) {
    if (!start[i].known()) sensitivity[i * directions + direction++] = 1.0;
  }
  return sensitivity;
}

Result<Shot> at_rest(Shot shot, std::vector<double> initial, std::vector<double> sensitivity) {
  shot.state = std::move(initial);
  shot.sensitivity = std::move(sensitivity);
  return shot;
}

}  // namespace

Result<Shot> shoot(const OdeLayout& layout, std::span<const double> q,
                   std::span<const Source> start, std::span<const double> times, double tolerance,
                   bool with_sensitivity) {
  const OdeSystem& system = *layout.system;
  Shot shot{std::vector<std::size_t>(system.parameters()), system.states(), {}, {}};
  std::iota(shot.unknown.begin(), shot.unknown.end(), 0);
  std::vector<double> initial;
  for (const auto& source : start) {
    initial.push_back(source.at(q));
    if (!source.known()) shot.unknown.push_back(source.unknown);
  }
  std::vector<double> p;
  for (const std::size_t unknown : shot.unknown) p.push_back(q[unknown]);
  const auto settings = layout.integration(tolerance);
  const auto unit = unit_sensitivity(start, system.parameters(), p.size());
  if (times.size() < 2) return at_rest(std::move(shot), std::move(initial), unit);
  auto run = with_sensitivity
                 ? integrate_with_sensitivities(WithStart(system, p.size() - system.parameters()),
                                                p, times, initial, unit, settings)
                 : integrate_system(system, std::span(p).first(system.parameters()), times, initial,
                                    settings);
  if (!run) return tl::unexpected(std::move(run).error());
  shot.state = std::move(run->state);
  shot.sensitivity = std::move(run->sensitivity);
  return shot;
}

}  // namespace flexspline::estimators
