#include <algorithm>

#include <fmt/format.h>

#include "conceal/generator.hpp"
#include "flexspline/core/estimate.hpp"
#include "flexspline/data/splice.hpp"

namespace flexspline::studies {
namespace {

std::vector<std::string> effects(const ConcealPlan& plan, data::HiddenClass of) {
  if (of != data::HiddenClass::named) return {};
  const auto set = data::load_dataset(plan.source);
  if (!set) return {};
  std::vector<std::string> ids = data::spliceable(*set);
  const std::vector<std::string> contained = contained_on(data::kind_of(*set));
  std::erase_if(ids, [&](const std::string& id) {
    return std::ranges::find(contained, id) != contained.end();
  });
  return ids;
}

Result<ConcealedCase> make(const ConcealPlan& plan) {
  if (!std::filesystem::exists(plan.source)) {
    return failure(ErrorCode::input_missing,
                   fmt::format("the recordings '{}' are not there", plan.source.string()),
                   "give [splice] datasets, or leave the generator out");
  }
  auto set = data::load_dataset(plan.source);
  if (!set) return tl::unexpected(set.error());
  ConcealedCase made;
  ConcealedAnswer& answer = made.answer;
  answer.rig = data::kind_of(*set);
  answer.seed = plan.seed;
  answer.source = set->name;
  answer.change = plan.change;
  answer.noise_std = answer.best_rmse = answer.peak_torque = kNotComputed;
  for (const data::HiddenEffect& effect : plan.effects) {
    auto spliced = data::splice(*set, effect, plan.seed);
    if (!spliced) return tl::unexpected(spliced.error());
    set = std::move(spliced->set);
    answer.peak_torque = spliced->peak_torque;
    std::ranges::move(twins_of(effect.id, answer.rig), std::back_inserter(answer.twins));
    answer.effects.push_back(std::move(spliced->finding));
  }
  auto changed = data::changed(*std::move(set), plan.change, plan.seed);
  if (!changed) return tl::unexpected(changed.error());
  made.recordings = *std::move(changed);
  return made;
}

}  // namespace

GeneratorRow describe_splice() {
  return {.id = "splice",
          .summary = "recordings by others, with a known effect added to their torque, or nothing",
          .rigs = {data::bench_kinds().begin(), data::bench_kinds().end()},
          .effects = effects,
          .make = make};
}

}  // namespace flexspline::studies
