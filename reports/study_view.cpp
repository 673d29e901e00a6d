#include "flexspline/reports/study_view.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "numbers.hpp"

namespace flexspline::reports {
namespace {

/// The paper's method first, then by id; midpoint methods by the number of loops they saw.
std::vector<EstimatorView> estimators_of(const std::vector<Case>& cases) {
  std::vector<EstimatorView> found;
  for (const Case& item : cases) {
    auto known = std::find_if(found.begin(), found.end(),
                              [&](const auto& other) { return other.id == item.estimator; });
    if (known == found.end()) {
      known = found.insert(known, {item.estimator, item.method, item.train.size(), 0, 0});
    }
    ++known->cases;
  }
  std::sort(found.begin(), found.end(), [](const EstimatorView& a, const EstimatorView& b) {
    return std::tuple(!a.is_midpoint(), a.loops, a.id) < std::tuple(!b.is_midpoint(), b.loops, b.id);
  });
  for (std::size_t i = 0; i < found.size(); ++i) found[i].rank = static_cast<int>(i);
  return found;
}

bool is_grid(const Input& input) {
  std::set<std::pair<double, double>> places;
  for (const InputRecording& recording : input.recordings) {
    const bool known = std::isfinite(recording.amplitude) && std::isfinite(recording.frequency_hz);
    if (!known || !places.emplace(recording.amplitude, recording.frequency_hz).second) return false;
  }
  return places.size() > 1;
}

}  // namespace

bool same(double a, double b) { return std::abs(a - b) <= 1e-6 * std::max(std::abs(a), std::abs(b)); }

std::string place_of(const Input& input, const CaseRecording& recording) {
  if (!std::isfinite(recording.amplitude) || !std::isfinite(recording.frequency_hz)) {
    return recording.id;
  }
  return compact(recording.amplitude, 4) + " " + input.units.motion + ", " +
         compact(recording.frequency_hz, 4) + " Hz";
}

StudyView::StudyView(Artefacts artefacts) : artefacts_(std::move(artefacts)) {
  estimators_ = estimators_of(artefacts_.cases);
  const auto& inputs = artefacts_.inputs;
  on_grid_ = !inputs.empty() && std::all_of(inputs.begin(), inputs.end(), is_grid);
}

const EstimatorView* StudyView::paper_fit() const {
  const bool has = !estimators_.empty() && estimators_.front().is_midpoint();
  return has ? &estimators_.front() : nullptr;
}

const EstimatorView* StudyView::full_trajectory() const {
  const EstimatorView* best = nullptr;
  for (const EstimatorView& estimator : estimators_) {
    if (!estimator.is_trajectory()) continue;
    const auto rank = [](const EstimatorView& one) { return std::pair(one.cases, one.loops); };
    if (best == nullptr || rank(estimator) > rank(*best)) best = &estimator;
  }
  return best;
}

std::vector<const EstimatorView*> StudyView::principal() const {
  std::vector<const EstimatorView*> found;
  for (const EstimatorView* one : {paper_fit(), full_trajectory()}) {
    if (one != nullptr) found.push_back(one);
  }
  return found;
}

const Case* StudyView::find(const Input& input, const EstimatorView& estimator) const {
  const Case* found = nullptr;
  for (const Case& item : artefacts_.cases) {
    if (item.input != input.id || item.estimator != estimator.id) continue;
    if (found == nullptr || item.replicate < found->replicate) found = &item;
  }
  return found;
}

OperatingPoint StudyView::operating_point(const Input& input) const {
  const Case* narrowest = nullptr;
  for (const Case& item : artefacts_.cases) {
    if (item.input != input.id || item.train.empty()) continue;
    if (narrowest == nullptr || item.train.size() < narrowest->train.size()) narrowest = &item;
  }
  for (const InputRecording& recording : input.recordings) {
    const bool chosen = narrowest != nullptr ? recording.id == narrowest->train.front()
                                             : recording.role == "train";
    if (chosen) return {recording.id, recording.amplitude, recording.frequency_hz};
  }
  return {};
}

std::set<std::string> StudyView::trained_on(const Input& input) const {
  std::set<std::string> ids;
  for (const Case& item : artefacts_.cases) {
    if (item.input == input.id) ids.insert(item.train.begin(), item.train.end());
  }
  return ids;
}

std::vector<const CaseRecording*> StudyView::held_out(const Input& input, const Case& item) const {
  const std::set<std::string> anybody = trained_on(input);
  std::vector<const CaseRecording*> own, common;
  for (const CaseRecording& recording : item.recordings) {
    if (recording.trained) continue;
    own.push_back(&recording);
    if (!anybody.contains(recording.id)) common.push_back(&recording);
  }
  return common.empty() ? own : common;
}

bool StudyView::selected(const Input& input, const CaseRecording& recording,
                         Elsewhere elsewhere) const {
  const OperatingPoint point = operating_point(input);
  const bool same_amplitude = same(recording.amplitude, point.amplitude);
  const bool same_frequency = same(recording.frequency_hz, point.frequency_hz);
  const bool outside = std::any_of(estimators_.begin(), estimators_.end(), [&](const auto& any) {
    const Case* other = find(input, any);
    const CaseRecording* twin = other != nullptr ? other->recording(recording.id) : nullptr;
    return twin != nullptr && twin->outside_domain;
  });
  switch (elsewhere) {
    case Elsewhere::other_amplitude: return same_frequency && !same_amplitude && !outside;
    case Elsewhere::other_frequency: return same_amplitude && !same_frequency && !outside;
    case Elsewhere::beyond_domain: return outside;
    case Elsewhere::anywhere: return true;
  }
  return false;
}

Worst StudyView::worst(const Input& input, const EstimatorView& estimator,
                       Elsewhere elsewhere) const {
  Worst worst;
  const Case* item = find(input, estimator);
  if (item == nullptr) return worst;
  for (const CaseRecording* recording : held_out(input, *item)) {
    if (!selected(input, *recording, elsewhere)) continue;
    const double percent = recording->error_percent();
    if (!(worst.percent >= percent) && std::isfinite(percent)) {
      worst = {percent, place_of(input, *recording)};
    }
  }
  return worst;
}

}  // namespace flexspline::reports
