#include <cmath>
#include <map>
#include <numbers>

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

  bool empty() const { return ids_.empty(); }

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
  RigCases(const TrialConfig& trial, data::BenchKind rig)
      : draw_(trial.draw),
        rig_(rig),
        seed_(trial.seed),
        name_(name_of(rig)),
        ids_(drawable(trial.draw, rig)),
        singles_(ids_, seed_, "single-" + name_),
        pairs_(ids_, seed_, "pair-" + name_),
        disturbed_(disturbances_on(rig), seed_, "disturbed-" + name_) {
    for (const auto& [kind, what] : {std::pair{ConcealKind::unknown, "unknown-"},
                                     {ConcealKind::contained, "contained-"},
                                     {ConcealKind::variant, "variant-"},
                                     {ConcealKind::incident, "incident-"}}) {
      others_.emplace(kind, Turns(ids_of(kind, rig), seed_, what + name_));
    }
  }

  std::vector<data::HiddenEffect> next(std::uint64_t bench_seed) {
    const ConcealKind kind = next_kind();
    if (kind == ConcealKind::none) return {};
    if (const auto other = others_.find(kind); other != others_.end()) {
      if (other->second.empty()) return {};
      return {{other->second.next(), draw_size(draw_, bench_seed, 0)}};
    }
    if (kind == ConcealKind::one) return {{singles_.next(), draw_size(draw_, bench_seed, 0)}};
    const std::string first = pairs_.next();
    const std::vector<std::string> others = partners(ids_, first, rig_);
    expects(!others.empty(), "there is a partner to conceal");
    const double share = lot(bench_seed, "second", 0);
    return {{first, draw_size(draw_, bench_seed, 0)},
            {others[static_cast<std::size_t>(share * static_cast<double>(others.size()))],
             draw_size(draw_, bench_seed, 1)}};
  }

  /// One, or nothing. Another irrational than the kinds', so that each kind meets each.
  std::vector<std::string> next_disturbances() {
    const double u = even_share("disturbed-" + name_, std::numbers::sqrt2, counted_++);
    if (u >= draw_.disturbed || disturbed_.empty()) return {};
    return {disturbed_.next()};
  }

 private:
  ConcealKind next_kind() {
    return kind_at(draw_, even_share("kind-" + name_, std::numbers::phi, taken_++));
  }

  /// Multiples of an irrational fill [0, 1) evenly however many there are.
  double even_share(const std::string& what, double irrational, std::uint64_t index) const {
    const double u = lot(seed_, what, 0) + (irrational - 1.0) * static_cast<double>(index);
    return u - std::floor(u);
  }

  ConcealDraw draw_;
  data::BenchKind rig_;
  std::uint64_t seed_;
  std::string name_;
  std::vector<std::string> ids_;
  Turns singles_;
  Turns pairs_;
  Turns disturbed_;
  std::map<ConcealKind, Turns> others_;
  std::uint64_t taken_ = 0;
  std::uint64_t counted_ = 0;
};

}  // namespace

std::vector<TrialCase> plan_trial(const TrialConfig& trial) {
  std::vector<RigCases> rigs;
  for (const data::BenchKind rig : trial.rigs) rigs.emplace_back(trial, rig);
  std::vector<TrialCase> cases;
  for (int k = 0; k < trial.cases; ++k) {
    const std::size_t turn = static_cast<std::size_t>(k) % rigs.size();
    TrialCase& one = cases.emplace_back();
    one.key = fmt::format("case-{:04d}", k);
    one.plan.rig = trial.rigs[turn];
    one.plan.seed = lot_bits(trial.seed, "bench", static_cast<std::uint64_t>(k));
    one.plan.effects = rigs[turn].next(one.plan.seed);
    one.plan.disturbances = rigs[turn].next_disturbances();
    one.plan.nuisances = trial.nuisances;
  }
  return cases;
}

}  // namespace flexspline::studies
