#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "diagnosis/search/selection.hpp"
#include "trial/trial_json.hpp"

namespace flexspline::studies {
namespace {

std::string truth_label(const ScoredCase& one) {
  if (one.score.kind == CaseKind::null) return "nothing";
  if (one.score.kind == CaseKind::kept) return "as recorded";
  if (one.score.kind == CaseKind::pair) return "two effects";
  if (one.score.kind == CaseKind::contained) return "contained in the baseline";
  return one.answer.effects.front().id;
}

std::string named_label(const ScoredCase& one) {
  if (one.score.failed) return "failed";
  const std::string& name = one.score.first_name;
  const auto& effects = one.answer.effects;
  const bool right = std::ranges::find(effects, name, &data::HiddenFinding::id) != effects.end();
  if (one.score.kind == CaseKind::contained && right) return "contained in the baseline";
  return one.score.kind == CaseKind::pair && right ? "one of the two" : name;
}

// Edges: the lower ones of each bin; the last has no upper end.
std::vector<DetectionBin> detection_by(const std::vector<ScoredCase>& cases,
                                       const std::vector<double>& edges,
                                       const std::function<double(const ScoredCase&)>& of) {
  std::vector<DetectionBin> bins;
  for (std::size_t k = 0; k < edges.size(); ++k) {
    const bool last = k + 1 == edges.size();
    bins.push_back({edges[k], last ? std::numeric_limits<double>::infinity() : edges[k + 1]});
  }
  for (const ScoredCase& one : cases) {
    if (one.score.kind != CaseKind::single) continue;
    const double value = of(one);
    const auto bin =
        std::ranges::find_if(bins, [value](const DetectionBin& b) { return value < b.to; });
    if (bin == bins.end()) continue;
    ++bin->cases;
    bin->detected += one.score.detected ? 1 : 0;
    bin->first_right += one.score.first_right ? 1 : 0;
    bin->exact += one.score.exact ? 1 : 0;
  }
  std::erase_if(bins, [](const DetectionBin& bin) { return bin.cases == 0; });
  return bins;
}

}  // namespace

std::vector<DetectionBin> detection_by_size(const std::vector<ScoredCase>& cases) {
  return detection_by(cases, {0.0, 0.02, 0.03, 0.04, 0.06, 0.08, 0.10}, [](const ScoredCase& one) {
    return one.answer.effects.front().size_fraction;
  });
}

std::vector<DetectionBin> detection_by_trace(const std::vector<ScoredCase>& cases) {
  return detection_by(cases, {0.0, 0.002, 0.004, 0.008, 0.016, 0.032, 0.064},
                      [](const ScoredCase& one) { return one.least_trace(); });
}

double ScoredCase::least_trace() const {
  double least = std::numeric_limits<double>::infinity();
  for (const EffectTrace& trace : traces) {
    if (!std::isfinite(trace.share)) return kNotComputed;
    least = std::min(least, trace.share);
  }
  return least;
}

std::vector<ScoredCase> that_can_be_seen(const std::vector<ScoredCase>& cases) {
  const double limit = Limits{}.interest;
  std::vector<ScoredCase> seen = cases;
  std::erase_if(seen, [limit](const ScoredCase& one) { return !(one.least_trace() >= limit); });
  return seen;
}

Confusion confusion_of(const std::vector<ScoredCase>& cases) {
  Confusion confusion;
  for (const ScoredCase& one : cases) ++confusion[{truth_label(one), named_label(one)}];
  return confusion;
}

std::vector<ScoredCase> of_rig(const std::vector<ScoredCase>& cases, data::BenchKind rig) {
  std::vector<ScoredCase> some = cases;
  std::erase_if(some, [rig](const ScoredCase& one) { return one.answer.rig != rig; });
  return some;
}

std::map<std::string, std::vector<ScoredCase>> by_generator(const std::vector<ScoredCase>& cases) {
  std::map<std::string, std::vector<ScoredCase>> groups;
  for (const ScoredCase& one : cases) groups[one.answer.generator].push_back(one);
  return groups;
}

std::map<std::string, std::vector<ScoredCase>> by_disturbance(
    const std::vector<ScoredCase>& cases) {
  std::map<std::string, std::vector<ScoredCase>> groups;
  for (const ScoredCase& one : cases) {
    if (one.answer.disturbances.empty()) groups["none"].push_back(one);
    for (const AppliedDisturbance& by : one.answer.disturbances) groups[by.id].push_back(one);
  }
  return groups;
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
