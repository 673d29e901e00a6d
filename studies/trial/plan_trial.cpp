#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>

#include <fmt/format.h>

#include "conceal/draw_effects.hpp"
#include "conceal/generator.hpp"
#include "conceal/lot.hpp"
#include "flexspline/data/splice.hpp"
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

/// The cases of one generator, in order.
class GeneratorCases {
 public:
  GeneratorCases() = default;
  virtual ~GeneratorCases() = default;
  GeneratorCases(const GeneratorCases&) = delete;
  GeneratorCases& operator=(const GeneratorCases&) = delete;
  virtual void next(ConcealPlan& plan) = 0;
};

/// The cases of one rig, in order.
class RigCases {
 public:
  RigCases(const TrialConfig& trial, const GeneratorRow& generator, data::BenchKind rig)
      : draw_(trial.draw),
        rig_(rig),
        seed_(trial.seed),
        name_((generator.id == "bench" ? "" : std::string(generator.id) + "-") +
              std::string(name_of(rig))),
        ids_(drawable(listed(trial, generator, data::HiddenClass::named), draw_, rig)),
        singles_(ids_, seed_, "single-" + name_),
        pairs_(ids_, seed_, "pair-" + name_),
        disturbed_(generator.id == "bench" ? disturbances_on(rig) : std::vector<std::string>{},
                   seed_, "disturbed-" + name_) {
    add(ConcealKind::unknown, &ConcealDraw::unknown, "unknown-",
        listed(trial, generator, data::HiddenClass::unknown));
    add(ConcealKind::variant, &ConcealDraw::variant, "variant-",
        listed(trial, generator, data::HiddenClass::variant));
    add(ConcealKind::incident, &ConcealDraw::incident, "incident-",
        listed(trial, generator, data::HiddenClass::incident));
    add(ConcealKind::contained, &ConcealDraw::contained, "contained-",
        generator.id == "bench" ? contained_on(rig) : std::vector<std::string>{});
    if (ids_.empty()) draw_.one = draw_.two = 0.0;
  }

  std::vector<data::HiddenEffect> next(std::uint64_t bench_seed) {
    const ConcealKind kind = next_kind();
    if (kind == ConcealKind::none) return {};
    if (const auto other = others_.find(kind); other != others_.end()) {
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
  std::vector<std::string> listed(const TrialConfig& trial, const GeneratorRow& generator,
                                  data::HiddenClass of) const {
    ConcealPlan plan;
    plan.rig = rig_;
    plan.source = trial.mujoco_script;
    return generator.effects(plan, of);
  }

  /// What a rig has nothing of gives its share to the others.
  void add(ConcealKind kind, double ConcealDraw::*share, const char* what,
           std::vector<std::string> ids) {
    if (ids.empty()) {
      draw_.*share = 0.0;
    } else {
      others_.emplace(kind, Turns(std::move(ids), seed_, what + name_));
    }
  }

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

/// Drives drawn from a seed: the rigs that the generator has take turns.
class DrawnCases : public GeneratorCases {
 public:
  DrawnCases(const TrialConfig& trial, const GeneratorRow& generator) : trial_(trial) {
    for (const data::BenchKind rig : trial.rigs) {
      if (std::ranges::find(generator.rigs, rig) == generator.rigs.end()) continue;
      rigs_.push_back(rig);
      cases_.emplace_back(trial, generator, rig);
    }
    expects(!rigs_.empty(), "the generator has one of the trial's rigs");
  }

  void next(ConcealPlan& plan) override {
    const std::size_t turn = taken_++ % rigs_.size();
    plan.rig = rigs_[turn];
    plan.source = plan.generator == "bench" ? std::filesystem::path{} : trial_.mujoco_script;
    plan.effects = cases_[turn].next(plan.seed);
    plan.disturbances = cases_[turn].next_disturbances();
    plan.nuisances = trial_.nuisances;
  }

 private:
  const TrialConfig& trial_;
  std::vector<data::BenchKind> rigs_;
  std::vector<RigCases> cases_;
  std::size_t taken_ = 0;
};

/// Recordings by others: each in turn as it is, changed in each way, then with each effect small
/// and large.
class SplicedCases : public GeneratorCases {
 public:
  SplicedCases(const TrialConfig& trial, const GeneratorRow& generator) : trial_(trial) {
    for (const std::filesystem::path& source : trial.spliced_sets) {
      ConcealPlan plan;
      plan.source = source;
      effects_.emplace_back(generator.effects(plan, data::HiddenClass::named), trial.seed,
                            "splice-" + source.filename().string());
    }
  }

  void next(ConcealPlan& plan) override {
    const std::size_t turn = taken_ % trial_.spliced_sets.size();
    const std::size_t round = taken_++ / trial_.spliced_sets.size();
    plan.source = trial_.spliced_sets[turn];
    const auto changes = data::splice_changes();
    if (round < changes.size()) {
      plan.change = changes[round];
    } else if (!effects_[turn].empty()) {
      const bool small = (round - changes.size()) % 2 == 0;
      if (small) last_[turn] = effects_[turn].next();
      plan.effects = {{last_[turn], small ? trial_.draw.smallest : trial_.draw.largest}};
    }
  }

 private:
  const TrialConfig& trial_;
  std::vector<Turns> effects_;
  std::map<std::size_t, std::string> last_;
  std::size_t taken_ = 0;
};

std::unique_ptr<GeneratorCases> cases_of(const TrialConfig& trial, const std::string& id) {
  const GeneratorRow* row = find_generator(id);
  expects(row != nullptr, "a trial names generators that there are");
  if (id == "splice") return std::make_unique<SplicedCases>(trial, *row);
  return std::make_unique<DrawnCases>(trial, *row);
}

}  // namespace

std::vector<TrialCase> plan_trial(const TrialConfig& trial) {
  std::vector<std::unique_ptr<GeneratorCases>> generators;
  for (const std::string& id : trial.generators) generators.push_back(cases_of(trial, id));
  std::vector<TrialCase> cases;
  for (int k = 0; k < trial.cases; ++k) {
    const std::size_t turn = static_cast<std::size_t>(k) % generators.size();
    TrialCase& one = cases.emplace_back();
    one.key = fmt::format("case-{:04d}", k);
    one.plan.generator = trial.generators[turn];
    one.plan.seed = lot_bits(trial.seed, "bench", static_cast<std::uint64_t>(k));
    generators[turn]->next(one.plan);
  }
  return cases;
}

}  // namespace flexspline::studies
