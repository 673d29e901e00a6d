#include <cmath>

#include <fmt/format.h>

#include "conceal/draw_effects.hpp"
#include "conceal/lot.hpp"
#include "flexspline/studies/trial.hpp"

namespace flexspline::studies {
namespace {

/// Gives a list round and round, each round in another order.
class Turns {
 public:
  Turns(std::vector<std::string> ids, std::uint64_t seed, std::string name)
      : ids_(std::move(ids)), seed_(seed), name_(std::move(name)) {}

  const std::string& next() {
    expects(!ids_.empty(), "there is an effect to conceal");
    if (taken_ % ids_.size() == 0) {
      round_ = shuffled(ids_, seed_, fmt::format("{}-{}", name_, taken_ / ids_.size()));
    }
    return round_[taken_++ % ids_.size()];
  }

 private:
  std::vector<std::string> ids_;
  std::uint64_t seed_;
  std::string name_;
  std::vector<std::string> round_;
  std::size_t taken_ = 0;
};

/// The cases of one rig, in order.
class RigCases {
 public:
  RigCases(const TrialConfig& trial, Rig rig)
      : draw_(trial.draw),
        rig_(rig),
        seed_(trial.seed),
        name_(name_of(rig)),
        ids_(drawable(trial.draw, rig)),
        singles_(ids_, seed_, "single-" + name_),
        pairs_(ids_, seed_, "pair-" + name_),
        unknown_(concealable(rig, false), seed_, "unknown-" + name_),
        contained_(contained_on(rig), seed_, "contained-" + name_) {}

  std::vector<data::HiddenEffect> next(std::uint64_t bench_seed) {
    const ConcealKind kind = next_kind();
    if (kind == ConcealKind::none) return {};
    if (kind == ConcealKind::unknown) return {{unknown_.next(), draw_size(draw_, bench_seed, 0)}};
    if (kind == ConcealKind::contained)
      return {{contained_.next(), draw_size(draw_, bench_seed, 0)}};
    if (kind == ConcealKind::one) return {{singles_.next(), draw_size(draw_, bench_seed, 0)}};
    const std::string first = pairs_.next();
    const std::vector<std::string> others = partners(ids_, first, rig_);
    expects(!others.empty(), "there is a partner to conceal");
    const double share = lot(bench_seed, "second", 0);
    return {{first, draw_size(draw_, bench_seed, 0)},
            {others[static_cast<std::size_t>(share * static_cast<double>(others.size()))],
             draw_size(draw_, bench_seed, 1)}};
  }

 private:
  /// Multiples of the golden ratio fill [0, 1) evenly however many there are.
  ConcealKind next_kind() {
    constexpr double kGolden = 0.6180339887498949;
    const double u = lot(seed_, "kind-" + name_, 0) + kGolden * static_cast<double>(taken_++);
    return kind_at(draw_, u - std::floor(u));
  }

  ConcealDraw draw_;
  Rig rig_;
  std::uint64_t seed_;
  std::string name_;
  std::vector<std::string> ids_;
  Turns singles_;
  Turns pairs_;
  Turns unknown_;
  Turns contained_;
  std::uint64_t taken_ = 0;
};

}  // namespace

std::vector<TrialCase> plan_trial(const TrialConfig& trial) {
  std::vector<RigCases> rigs;
  for (const Rig rig : trial.rigs) rigs.emplace_back(trial, rig);
  std::vector<TrialCase> cases;
  for (int k = 0; k < trial.cases; ++k) {
    const std::size_t turn = static_cast<std::size_t>(k) % rigs.size();
    TrialCase& one = cases.emplace_back();
    one.key = fmt::format("case-{:04d}", k);
    one.plan.rig = trial.rigs[turn];
    one.plan.seed = lot_bits(trial.seed, "bench", static_cast<std::uint64_t>(k));
    one.plan.effects = rigs[turn].next(one.plan.seed);
    one.plan.nuisances = trial.nuisances;
  }
  return cases;
}

}  // namespace flexspline::studies
