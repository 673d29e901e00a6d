#include <algorithm>
#include <cmath>
#include <iterator>

#include "conceal/draw_effects.hpp"
#include "conceal/generator.hpp"
#include "conceal/lot.hpp"
#include "conceal/nuisances.hpp"

namespace flexspline::studies {
namespace {

/// The torque that a rig's fits explain.
Quantity effort_of(const Recording& recording) {
  for (const Quantity quantity :
       {Quantity::transmitted_torque, Quantity::torque, Quantity::motor_torque}) {
    if (recording.find(quantity) != nullptr) return quantity;
  }
  expects(false, "a recording of the bench has a torque");
  return Quantity::torque;
}

/// rms over the whole set of what the instrument added to the effort.
double best_rmse(const data::HiddenDataset& made) {
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t k = 0; k < made.ideal.recordings.size(); ++k) {
    const Quantity effort = effort_of(made.ideal.recordings[k]);
    const std::vector<double>& ideal = *made.ideal.recordings[k].find(effort);
    const std::vector<double>& measured = *made.measured.recordings[k].find(effort);
    for (std::size_t i = 0; i < ideal.size(); ++i) sum += std::pow(measured[i] - ideal[i], 2);
    count += ideal.size();
  }
  return std::sqrt(sum / static_cast<double>(std::max<std::size_t>(count, 1)));
}

/// A bench with what was done to it.
struct DisturbedBench {
  data::HiddenBench bench;
  std::vector<AppliedDisturbance> applied;
};

std::vector<std::string> disturbances_of(const ConcealPlan& plan) {
  return plan.draw ? draw_disturbances(*plan.draw, plan.rig, plan.seed) : plan.disturbances;
}

DisturbedBench bench_of(const ConcealPlan& plan) {
  DisturbedBench made;
  data::HiddenBench& bench = made.bench;
  bench = data::draw_hidden_bench(plan.rig, plan.seed);
  if (!plan.design.empty()) bench.design = plan.design;
  for (const std::string& id : disturbances_of(plan)) {
    const data::DisturbanceRow& row = **data::find_disturbance(id);
    made.applied.push_back({id, row.apply(bench, plan.seed)});
  }
  for (const NuisanceSetting& setting : nuisance_settings()) {
    const auto given = plan.nuisances.find(std::string(setting.name));
    if (given != plan.nuisances.end()) bench.nuisances.*setting.member = given->second;
  }
  return made;
}

ConcealedAnswer answer_of(const ConcealPlan& plan, data::HiddenDataset& made) {
  ConcealedAnswer answer;
  answer.rig = plan.rig;
  answer.seed = plan.seed;
  answer.effects = std::move(made.answer.effects);
  for (const data::HiddenFinding& effect : answer.effects) {
    std::ranges::move(twins_of(effect.id, plan.rig), std::back_inserter(answer.twins));
  }
  const bool motor_only = plan.rig.rig == Rig::servo;
  answer.noise_std = motor_only ? made.answer.motor_noise_std : made.answer.noise_std;
  answer.peak_torque = motor_only ? made.answer.peak_motor_torque : made.answer.peak_torque;
  answer.best_rmse = best_rmse(made);
  const auto ratio = made.measured.constants.find("gear_ratio");
  if (motor_only && ratio != made.measured.constants.end()) answer.at_output = ratio->second;
  return answer;
}

/// An effect may not come to the drawn size on the drawn bench; then it is drawn again.
Result<data::HiddenDataset> run_drawn(const ConcealPlan& plan, const data::HiddenBench& bench) {
  constexpr std::uint64_t kAttempts = 8;
  for (std::uint64_t attempt = 0;; ++attempt) {
    const std::uint64_t seed = lot_bits(plan.seed, "effects", attempt);
    auto made = data::run_hidden_bench(bench, draw_effects(*plan.draw, plan.rig, seed));
    const bool unreachable = !made && made.error().code == ErrorCode::usage;
    if (!unreachable || attempt + 1 == kAttempts) return made;
  }
}

Result<ConcealedCase> make(const ConcealPlan& plan) {
  DisturbedBench disturbed = bench_of(plan);
  auto made = plan.draw ? run_drawn(plan, disturbed.bench)
                        : data::run_hidden_bench(disturbed.bench, plan.effects);
  if (!made) return tl::unexpected(made.error());
  ConcealedCase concealed;
  concealed.answer = answer_of(plan, *made);
  concealed.answer.disturbances = std::move(disturbed.applied);
  concealed.recordings = std::move(made->measured);
  return concealed;
}

std::vector<std::string> effects(const ConcealPlan& plan, data::HiddenClass of) {
  return concealable(plan.rig, of);
}

}  // namespace

GeneratorRow describe_bench() {
  return {.id = "bench",
          .summary = "the virtual bench: inverse dynamics of drives drawn from a seed",
          .rigs = {data::bench_kinds().begin(), data::bench_kinds().end()},
          .effects = effects,
          .make = make};
}

}  // namespace flexspline::studies
