#include <algorithm>
#include <cmath>

#include "figures/study_figures.hpp"
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

enum class Loops { trained, unseen };

/// Over the loops an estimator was given, or over those that nobody was; where another estimator is
/// named, on the inputs on which both ran.
Spread spread_of(const StudyView& view, const EstimatorView& estimator, Loops loops,
                 const EstimatorView* other = nullptr) {
  Spread spread;
  std::vector<double> all;
  for (const Input& input : view.artefacts().inputs) {
    const Case* item = view.find(input, estimator);
    if (item == nullptr || (other != nullptr && view.find(input, *other) == nullptr)) continue;
    const bool unseen = loops == Loops::unseen;
    for (const CaseRecording* recording : unseen ? view.held_out(input, *item) : item->trained()) {
      const double error = recording->error_percent();
      if (!std::isfinite(error)) continue;
      all.push_back(error);
      if (!(spread.worst >= error)) {
        spread.worst = error;
        spread.worst_where = input.title + " at " + place_of(input, *recording);
      }
      if (!(spread.best <= error)) spread.best = error;
    }
  }
  spread.count = all.size();
  spread.middle = median(std::move(all));
  return spread;
}

std::string sentence_of(const StudyView& view, const EstimatorView& estimator) {
  const Spread own = spread_of(view, estimator, Loops::trained);
  const Spread other = spread_of(view, estimator, Loops::unseen);
  std::string text = estimator.id;
  if (own.count == 1) {
    text += " fits the loop it was given to " + digits(own.worst, 2) + " % of peak";
  } else if (own.count > 1) {
    text += " fits the loops it was given to " + digits(own.middle, 2) +
            " % of peak in the middle case and " + digits(own.worst, 2) + " % at worst";
  } else {
    text += " gave no numbers on the loops it was given";
  }
  if (other.count == 1) {
    text += "; on the one that was kept from every estimator it is off by " +
            digits(other.worst, 2) + " % (" + other.worst_where + ")";
  } else if (other.count > 1) {
    text += "; on the " + std::to_string(other.count) +
            " that were kept from every estimator it is off by " + digits(other.best, 2) +
            " % at best, " + digits(other.middle, 2) + " % in the middle case and " +
            digits(other.worst, 2) + " % at worst (" + other.worst_where + ")";
  }
  return text + ".";
}

Table estimators_table(const StudyView& view) {
  Table table{
      "estimators",
      "Every estimator over the whole study, in percent of each loop's peak: on the loops it "
      "was trained on, and on those that nobody was.",
      {{"estimator", "", 3},
       {"what it is", "", 3},
       {"loops trained on", "", 0},
       {"cases", "", 0},
       {"trained, median", "%", 2},
       {"trained, worst", "%", 2},
       {"held out, best", "%", 2},
       {"held out, median", "%", 2},
       {"held out, worst", "%", 2}},
      {}};
  for (const EstimatorView& one : view.estimators()) {
    const Spread own = spread_of(view, one, Loops::trained);
    const Spread other = spread_of(view, one, Loops::unseen);
    table.rows.push_back({one.id, one.title.empty() ? one.method : one.title,
                          static_cast<double>(one.loops), static_cast<double>(one.cases),
                          own.middle, own.worst, other.best, other.middle, other.worst});
  }
  return table;
}

/// How many failed, and the first of them with their reasons.
void add_failures(const StudyView& view, Section& section) {
  constexpr std::size_t kTold = 5;
  std::size_t count = 0;
  std::string reasons;
  for (const Case& item : view.artefacts().cases) {
    if (!item.failed) continue;
    if (++count <= kTold) reasons += " " + item.key + ": " + item.failure + ".";
  }
  if (count == 0) return;
  section.add(Paragraph{std::to_string(count) + " of " +
                        std::to_string(view.artefacts().cases.size()) +
                        " cases failed and have no numbers." + reasons +
                        (count > kTold ? " The others are listed under Cases." : "")});
}

std::string summary_of(const StudyView& view) {
  const EstimatorView* paper = view.paper_fit();
  const EstimatorView* full = view.full_trajectory();
  if (paper == nullptr || full == nullptr) return {};
  const Spread a = spread_of(view, *paper, Loops::unseen, full);
  const Spread b = spread_of(view, *full, Loops::unseen, paper);
  if (!(a.middle > 0.0) || !(b.middle > 0.0)) return {};
  const bool full_wins = b.middle < a.middle;
  const double ratio = full_wins ? a.middle / b.middle : b.middle / a.middle;
  return "On loops that nobody was trained on, " + (full_wins ? full->id : paper->id) + " is " +
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
  for (const EstimatorView* estimator : view.principal()) {
    section.add(Paragraph{sentence_of(view, *estimator)});
  }
  if (Figure figure = estimators_figure(view); !figure.frames.empty()) {
    section.add(std::move(figure));
  }
  section.add(estimators_table(view));
  add_failures(view, section);
  return section;
}

}  // namespace

SectionRow describe_verdict() { return {0, draw}; }

}  // namespace flexspline::reports
