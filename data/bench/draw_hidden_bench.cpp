#include <algorithm>
#include <cmath>
#include <numbers>

#include "bench/hidden_draw.hpp"
#include "bench/hidden_gear.hpp"
#include "bench/hidden_motion.hpp"
#include "bench/hidden_run.hpp"

namespace flexspline::data {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

int draw_samples(std::uint64_t seed, std::uint64_t index, double low, double high) {
  return static_cast<int>(std::lround(drawn(seed, "samples", index, low, high)));
}

/// Every amplitude at every rate, a multisine and holds.
std::vector<HiddenExcitation> torsion_design(std::uint64_t seed, double amplitude) {
  const double slow = drawn(seed, "rate", 0, 0.02, 0.03);
  std::vector<HiddenExcitation> design;
  for (const double share : {0.4, 0.7, 1.0}) {
    for (const double ratio : {1.0, 9.0, 70.0}) {
      design.push_back({HiddenMotion::sine, share * amplitude, slow * ratio, 3.0,
                        draw_samples(seed, design.size(), 600, 860)});
    }
  }
  design.push_back({HiddenMotion::multisine, 0.9 * amplitude, 2.0 * slow, 3.0,
                    draw_samples(seed, 9, 800, 1000)});
  design.push_back(
      {HiddenMotion::step_hold, amplitude, slow, 3.0, draw_samples(seed, 10, 800, 1000)});
  return design;
}

/// Sines that ask for shares of the rated torque, multisines, constant speeds.
std::vector<HiddenExcitation> load_design(std::uint64_t seed, const HiddenGear& gear) {
  const auto rate_for = [&gear](double amplitude, double share) {
    return std::sqrt(share * gear.rated_torque / (gear.load_inertia * amplitude)) / kTurn;
  };
  const double wide = drawn(seed, "amplitude", 0, 0.7, 1.0);
  std::vector<HiddenExcitation> design;
  const auto add = [&](HiddenMotion motion, double amplitude, double frequency, double cycles) {
    design.push_back(
        {motion, amplitude, frequency, cycles, draw_samples(seed, design.size(), 900, 1200)});
  };
  for (const double share : {0.03, 0.2, 0.5}) {
    add(HiddenMotion::sine, wide, rate_for(wide, share), 2.5);
  }
  for (const double share : {0.3, 1.0})
    add(HiddenMotion::sine, wide / 2, rate_for(wide / 2, share), 3);
  add(HiddenMotion::sine, wide / 4, rate_for(wide / 4, 0.8), 3);
  add(HiddenMotion::multisine, wide / 2, 0.18 * rate_for(wide / 2, 0.5), 2);
  add(HiddenMotion::multisine, wide / 4, 0.18 * rate_for(wide / 4, 0.7), 2);
  add(HiddenMotion::staircase, wide, 0.1 * rate_for(wide, 0.2), 1);
  return design;
}

std::vector<HiddenExcitation> pendulum_design(std::uint64_t seed) {
  const double wide = drawn(seed, "amplitude", 0, 1.2, 1.6);
  std::vector<HiddenExcitation> design;
  for (const double share : {0.3, 0.6, 1.0}) {
    for (const double rate : {0.05, 0.25}) {
      design.push_back({HiddenMotion::sine, share * wide,
                        rate * drawn(seed, "rate", design.size(), 0.8, 1.2), 3.0,
                        draw_samples(seed, design.size(), 700, 900)});
    }
  }
  design.push_back({HiddenMotion::multisine, 0.8 * wide, 0.06, 3.0, 1000});
  design.push_back({HiddenMotion::ramp, wide, 0.08, 2.0, 900});
  design.push_back({HiddenMotion::staircase, wide, 0.02, 1.0, 1000});
  return design;
}

// Below what matters: a tenth of the noise, in torque. Enough to be wrong for who counts on zero.
constexpr double kImmaterial = 0.1;

HiddenNuisances draw_nuisances(Rig rig, std::uint64_t seed, const HiddenGear& gear) {
  HiddenNuisances n;
  n.torque_noise = drawn(seed, "noise", 0, 0.003, 0.006);
  n.coloured_share = drawn(seed, "noise", 1, 0.05, 0.3);
  n.coloured_samples = drawn(seed, "noise", 2, 3.0, 20.0);
  n.motor_encoder_step = rig == Rig::specimen ? kTurn / 0x1p22 : kTurn / 1e5;
  n.load_encoder_step = kTurn / 0x1p22;
  n.time_jitter = drawn(seed, "noise", 3, 0.0, 0.02);
  n.torque_offset = kImmaterial * drawn(seed, "noise", 4, -1.0, 1.0);
  n.angle_zero =
      kImmaterial * n.torque_noise * gear.rated_torsion * drawn(seed, "noise", 5, -1.0, 1.0);
  n.motor_torque_offset =
      rig == Rig::specimen ? 0.0 : kImmaterial * drawn(seed, "noise", 6, -1.0, 1.0);
  n.zero_spread = 0.5 * kImmaterial * n.torque_noise * gear.rated_torsion;
  n.temperature_spread = drawn(seed, "noise", 7, 0.3, 0.9);
  return n;
}

// Largest torque that the load of a recording asks for.
double peak_of(const HiddenBench& bench, const HiddenSession& session) {
  const HeldMotion held(session.excitation, bench.seed, session.id);
  double peak = 0.0;
  for (int k = 0; k <= 4000; ++k) {
    const Jet x = held.at(held.duration() * k / 4000.0);
    peak = std::max(peak,
                    std::abs(bench.gear.load_inertia * x.second + bench.gear.load_drag * x.first));
  }
  return peak;
}

// Slows what asks for more than the gear is rated for. The phases of a multisine hang on its id,
// which tells the frequency, so that slowing one may take several turns.
void keep_rated(HiddenBench& bench) {
  constexpr double kMost = 1.05;
  for (int turn = 0; turn < 20; ++turn) {
    const auto sessions = plan_sessions(bench);
    bool kept = true;
    for (std::size_t k = 0; k < sessions.size(); ++k) {
      const double share = peak_of(bench, sessions[k]) / bench.gear.rated_torque;
      if (share <= kMost) continue;
      bench.design[k].frequency_hz *= std::sqrt(1.0 / share);
      kept = false;
    }
    if (kept) break;
  }
}

}  // namespace

std::vector<HiddenExcitation> draw_design(Rig rig, std::uint64_t seed, const HiddenGear& gear) {
  if (rig == Rig::free) return load_design(seed, gear);
  if (rig == Rig::servo) return pendulum_design(seed);
  return torsion_design(seed, gear.rated_torsion);
}

namespace {

HiddenBench draw_joint_bench(std::uint64_t seed) {
  HiddenBench bench;
  bench.rig = Rig::specimen;
  bench.travels = true;
  bench.seed = seed;
  bench.gear = draw_joint(seed);
  bench.design = joint_design(seed, bench.gear.rated_torsion);
  bench.nuisances = draw_nuisances(bench.rig, seed, bench.gear);
  bench.nuisances.motor_encoder_step = kTurn / 0x1p18;
  return bench;
}

}  // namespace

HiddenBench draw_hidden_bench(BenchKind kind, std::uint64_t seed) {
  if (kind.travels) return draw_joint_bench(seed);
  const Rig rig = kind.rig;
  const double torque = drawn(seed, "rated", 0, 25.0, 60.0);
  const double torsion = drawn(seed, "rated", 1, 2.5e-3, 6e-3);
  HiddenBench bench;
  bench.rig = rig;
  bench.seed = seed;
  bench.gear =
      draw_gear(rig, seed, torque, torsion, torsion * kTurn * drawn(seed, "rated", 2, 0.1, 0.3));
  bench.design = draw_design(rig, seed, bench.gear);
  bench.nuisances = draw_nuisances(rig, seed, bench.gear);
  if (rig == Rig::free) keep_rated(bench);
  return bench;
}

}  // namespace flexspline::data
