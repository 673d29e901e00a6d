#include "flexspline/reports/study_view.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "lock_file.hpp"
#include "numbers.hpp"

namespace flexspline::reports {
namespace {

/// In the study's order; without one, the paper's method first, by the number of loops it saw.
std::vector<EstimatorView> estimators_of(const std::vector<Case>& cases, const LockFile& lock) {
  std::vector<EstimatorView> found;
  for (const Case& item : cases) {
    auto known = std::find_if(found.begin(), found.end(),
                              [&](const auto& other) { return other.id == item.estimator; });
    if (known == found.end()) {
      known =
          found.insert(known, {item.estimator, item.title, item.method, item.train.size(), 0, 0});
    }
    ++known->cases;
  }
  const auto rank = [&](const EstimatorView& one) {
    return std::tuple(place_in(lock.estimators, one.id), !one.is_midpoint(), one.loops, one.id);
  };
  std::sort(found.begin(), found.end(),
            [&](const auto& a, const auto& b) { return rank(a) < rank(b); });
  for (std::size_t i = 0; i < found.size(); ++i) found[i].rank = static_cast<int>(i);
  return found;
}

bool is_grid(const Input& input) {
  std::set<std::tuple<double, double, std::string>> places;
  for (const InputRecording& one : input.recordings) {
    const bool known = std::isfinite(one.amplitude) && std::isfinite(one.frequency_hz);
    if (!known || !places.emplace(one.amplitude, one.frequency_hz, one.role).second) return false;
  }
  return places.size() > 1;
}

}  // namespace

bool same(double a, double b) {
  return std::abs(a - b) <= 1e-6 * std::max(std::abs(a), std::abs(b));
}

std::string place_of(const Input& input, const CaseRecording& recording) {
  if (!std::isfinite(recording.amplitude) || !std::isfinite(recording.frequency_hz)) {
    return recording.id;
  }
  return compact(recording.amplitude, 4) + " " + input.units.motion + ", " +
         compact(recording.frequency_hz, 4) + " Hz";
}

bool lies(const CaseRecording& recording, const OperatingPoint& point, Elsewhere elsewhere) {
  const bool same_amplitude = same(recording.amplitude, point.amplitude);
  const bool same_frequency = same(recording.frequency_hz, point.frequency_hz);
  const bool larger = !same_amplitude && recording.amplitude > point.amplitude;
  const bool faster = !same_frequency && recording.frequency_hz > point.frequency_hz;
  switch (elsewhere) {
    case Elsewhere::lower_amplitude:
      return same_frequency && recording.amplitude < point.amplitude && !same_amplitude;
    case Elsewhere::lower_frequency:
      return same_amplitude && recording.frequency_hz < point.frequency_hz && !same_frequency;
    case Elsewhere::beyond:
      return larger || faster;
    case Elsewhere::anywhere:
      return true;
  }
  return false;
}

StudyView::StudyView(Artefacts artefacts) : artefacts_(std::move(artefacts)) {
  const LockFile lock = parse_lock(artefacts_.lock);
  estimators_ = estimators_of(artefacts_.cases, lock);
  auto& inputs = artefacts_.inputs;
  std::stable_sort(inputs.begin(), inputs.end(), [&](const Input& a, const Input& b) {
    return place_in(lock.inputs, a.id) < place_in(lock.inputs, b.id);
  });
  on_grid_ = !inputs.empty() && std::all_of(inputs.begin(), inputs.end(), is_grid);
}

const EstimatorView* StudyView::paper_fit() const {
  const EstimatorView* best = nullptr;
  for (const EstimatorView& estimator : estimators_) {
    if (!estimator.is_midpoint()) continue;
    if (best == nullptr || estimator.loops < best->loops) best = &estimator;
  }
  return best;
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
    const bool chosen =
        narrowest != nullptr ? recording.id == narrowest->train.front() : recording.role == "train";
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

std::vector<const InputRecording*> StudyView::places(const Input& input) const {
  std::vector<const InputRecording*> found;
  std::map<std::pair<double, double>, const InputRecording*> grid;
  for (const InputRecording& recording : input.recordings) {
    found.push_back(&recording);
    auto& place = grid[{recording.amplitude, recording.frequency_hz}];
    if (place == nullptr || recording.role == "holdout") place = &recording;
  }
  if (!on_grid_) return found;
  found.clear();
  for (const auto& [place, recording] : grid) found.push_back(recording);
  return found;
}

const CaseRecording* StudyView::at_place(const Case& item, const InputRecording& place) const {
  if (!on_grid_) return item.recording(place.id);
  const CaseRecording* found = nullptr;
  for (const CaseRecording& one : item.recordings) {
    const bool here =
        same(one.amplitude, place.amplitude) && same(one.frequency_hz, place.frequency_hz);
    if (here && (found == nullptr || !one.trained)) found = &one;
  }
  return found;
}

Worst StudyView::worst(const Input& input, const EstimatorView& estimator,
                       Elsewhere elsewhere) const {
  Worst worst;
  const Case* item = find(input, estimator);
  if (item == nullptr) return worst;
  const OperatingPoint point = operating_point(input);
  for (const CaseRecording* recording : held_out(input, *item)) {
    if (!lies(*recording, point, elsewhere)) continue;
    const double percent = recording->error_percent();
    if (!(worst.percent >= percent) && std::isfinite(percent)) {
      worst = {percent, place_of(input, *recording)};
    }
  }
  return worst;
}

}  // namespace flexspline::reports
