#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <set>

#include <fmt/format.h>

#include "bench/hidden_draw.hpp"
#include "bench/hidden_run.hpp"

namespace flexspline::data {
namespace {

constexpr double kPauseSeconds = 5.0;

/// Told by what is done, so that noise does not depend on the place in the design.
std::string id_of(const HiddenExcitation& x, std::set<std::string>& taken) {
  const double degrees = x.amplitude * 180.0 / std::numbers::pi;
  const std::string stem =
      fmt::format("{}-a{:.4g}-f{:.4g}", name_of(x.motion), degrees, x.frequency_hz);
  std::string id = stem;
  for (int copy = 2; !taken.insert(id).second; ++copy) id = fmt::format("{}-{}", stem, copy);
  return id;
}

/// Of grease per K (0.02 to 0.05), and the weaker one of dry friction.
constexpr double kViscousSlope = 0.035;
constexpr double kDrySlope = 0.01;

}  // namespace

HiddenGear gear_of(const HiddenBench& bench, const HiddenSession& session) {
  HiddenGear gear = bench.gear;
  const double spread = bench.nuisances.temperature_spread;
  if (spread == 0.0) return gear;
  const double warmer = spread * drawn(bench.seed, session.id, 1001, -1.0, 1.0);
  const double dry = std::exp(-kDrySlope * warmer);
  const double viscous = std::exp(-kViscousSlope * warmer);
  gear.motor_drag *= viscous;
  gear.load_drag *= viscous;
  gear.motor_coulomb *= dry;
  gear.damping = [loss = bench.gear.damping, dry](double rate) { return dry * loss(rate); };
  return gear;
}

std::vector<HiddenSession> plan_sessions(const HiddenBench& bench) {
  std::vector<HiddenSession> sessions;
  std::set<std::string> taken;
  for (const HiddenExcitation& excitation : bench.design) {
    sessions.push_back({id_of(excitation, taken), 0.0, excitation});
  }
  std::vector<HiddenSession*> order;
  for (HiddenSession& session : sessions) order.push_back(&session);
  const auto lot = [&bench](const HiddenSession* session) {
    return drawn(bench.seed, session->id, 1000, 0.0, 1.0);
  };
  std::ranges::sort(order, {}, lot);
  double clock = 0.0;
  for (HiddenSession* session : order) {
    session->start_s = clock;
    clock += session->duration() + kPauseSeconds;
  }
  return sessions;
}

}  // namespace flexspline::data
