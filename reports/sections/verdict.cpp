#include <algorithm>
#include <cmath>

#include "flexspline/reports/section.hpp"
#include "numbers.hpp"

namespace flexspline::reports {
namespace {

/// Spread of an estimator's errors over the whole study.
struct Spread {
  double best = kAbsent;
  double middle = kAbsent;
  double worst = kAbsent;
  std::string worst_where;
  std::size_t count = 0;
};

Spread spread_of(const StudyView& view, const EstimatorView& estimator, bool trained) {
  Spread spread;
  std::vector<double> all;
  for (const Input& input : view.artefacts().inputs) {
    const Case* item = view.find(input, estimator);
    if (item == nullptr) continue;
    for (const CaseRecording& recording : item->recordings) {
      const double error = recording.error_percent();
      if (recording.trained != trained || !std::isfinite(error)) continue;
      all.push_back(error);
      if (!(spread.worst >= error)) {
        spread.worst = error;
        spread.worst_where = input.title + " at " + place_of(input, recording);
      }
      if (!(spread.best <= error)) spread.best = error;
    }
  }
  spread.count = all.size();
  spread.middle = median(std::move(all));
  return spread;
}

std::string sentence_of(const StudyView& view, const EstimatorView& estimator) {
  const Spread own = spread_of(view, estimator, true);
  const Spread other = spread_of(view, estimator, false);
  std::string text = estimator.id;
  if (own.count > 0) {
    text += " fits the loops it was given to " + digits(own.middle, 2) +
            " % of peak in the middle case and " + digits(own.worst, 2) + " % at worst";
  } else {
    text += " gave no numbers on the loops it was given";
  }
  if (other.count > 0) {
    text += "; on the " + std::to_string(other.count) + " it had not seen it is off by " +
            digits(other.best, 2) + " % at best, " + digits(other.middle, 2) +
            " % in the middle case and " + digits(other.worst, 2) + " % at worst (" +
            other.worst_where + ")";
  }
  return text + ".";
}

std::size_t failures(const StudyView& view) {
  const auto& cases = view.artefacts().cases;
  return static_cast<std::size_t>(
      std::count_if(cases.begin(), cases.end(), [](const Case& item) { return item.failed; }));
}

std::string summary_of(const StudyView& view) {
  const EstimatorView* paper = view.paper_fit();
  const EstimatorView* full = view.full_trajectory();
  if (paper == nullptr || full == nullptr) return {};
  const Spread a = spread_of(view, *paper, false);
  const Spread b = spread_of(view, *full, false);
  if (!(a.middle > 0.0) || !(b.middle > 0.0)) return {};
  const bool full_wins = b.middle < a.middle;
  const double ratio = full_wins ? a.middle / b.middle : b.middle / a.middle;
  return "On loops they had not seen, " + (full_wins ? full->id : paper->id) + " is " +
         digits(ratio, 2) + " times closer than " + (full_wins ? paper->id : full->id) +
         " in the middle case (" + digits(std::min(a.middle, b.middle), 2) + " % against " +
         digits(std::max(a.middle, b.middle), 2) + " % of peak), and its worst is " +
         digits(full_wins ? b.worst : a.worst, 2) + " % against " +
         digits(full_wins ? a.worst : b.worst, 2) + " %.";
}

std::optional<Section> draw(const StudyView& view) {
  if (view.artefacts().cases.empty()) return std::nullopt;
  Section section{"verdict", "In short", {}};
  if (const std::string summary = summary_of(view); !summary.empty()) {
    section.add(Verdict{summary});
  }
  for (const EstimatorView& estimator : view.estimators()) {
    section.add(Paragraph{sentence_of(view, estimator)});
  }
  if (const std::size_t count = failures(view); count > 0) {
    section.add(Paragraph{std::to_string(count) + " of " +
                          std::to_string(view.artefacts().cases.size()) +
                          " cases failed; each is listed below with its reason, and none of them "
                          "has numbers."});
  }
  return section;
}

}  // namespace

SectionRow describe_verdict() { return {0, draw}; }

}  // namespace flexspline::reports
