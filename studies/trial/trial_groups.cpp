#include <algorithm>
#include <limits>

#include "trial/trial_json.hpp"

namespace flexspline::studies {
namespace {

std::string truth_label(const ScoredCase& one) {
  if (one.score.kind == CaseKind::null) return "nothing";
  if (one.score.kind == CaseKind::pair) return "two effects";
  return one.answer.effects.front().id;
}

std::string named_label(const ScoredCase& one) {
  if (one.score.failed) return "failed";
  const std::string& name = one.score.first_name;
  const auto& effects = one.answer.effects;
  const bool right = std::ranges::find(effects, name, &data::HiddenFinding::id) != effects.end();
  return one.score.kind == CaseKind::pair && right ? "one of the two" : name;
}

}  // namespace

std::vector<SizeBin> detection_by_size(const std::vector<ScoredCase>& cases) {
  constexpr double kEdges[] = {0.0, 0.02, 0.03, 0.04, 0.06, 0.08, 0.10};
  std::vector<SizeBin> bins;
  for (std::size_t k = 0; k < std::size(kEdges); ++k) {
    const bool last = k + 1 == std::size(kEdges);
    bins.push_back({kEdges[k], last ? std::numeric_limits<double>::infinity() : kEdges[k + 1]});
  }
  for (const ScoredCase& one : cases) {
    if (one.score.kind != CaseKind::single) continue;
    const double size = one.answer.effects.front().size_fraction;
    const auto bin = std::ranges::find_if(bins, [size](const SizeBin& b) { return size < b.to; });
    ++bin->cases;
    bin->detected += one.score.detected ? 1 : 0;
    bin->first_right += one.score.first_right ? 1 : 0;
    bin->exact += one.score.exact ? 1 : 0;
  }
  std::erase_if(bins, [](const SizeBin& bin) { return bin.cases == 0; });
  return bins;
}

Confusion confusion_of(const std::vector<ScoredCase>& cases) {
  Confusion confusion;
  for (const ScoredCase& one : cases) ++confusion[{truth_label(one), named_label(one)}];
  return confusion;
}

std::vector<ScoredCase> of_rig(const std::vector<ScoredCase>& cases, Rig rig) {
  std::vector<ScoredCase> some = cases;
  std::erase_if(some, [rig](const ScoredCase& one) { return one.answer.rig != rig; });
  return some;
}

std::map<std::pair<std::string, std::string>, std::vector<ScoredCase>> by_effect(
    const std::vector<ScoredCase>& cases) {
  std::map<std::pair<std::string, std::string>, std::vector<ScoredCase>> groups;
  for (const ScoredCase& one : cases) {
    if (one.score.kind != CaseKind::single) continue;
    groups[{std::string(name_of(one.answer.rig)), one.answer.effects.front().id}].push_back(one);
  }
  return groups;
}

}  // namespace flexspline::studies
