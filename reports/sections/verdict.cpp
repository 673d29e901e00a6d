#include <algorithm>
#include <cmath>

#include "ablation.hpp"
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

std::string percent_of_peak(double error) {
  return error > 100.0 ? "diverged" : digits(error, 2) + " %";
}

std::string sentence_of(const StudyView& view, const EstimatorView& estimator) {
  const Spread own = spread_of(view, estimator, Loops::trained);
  const Spread other = spread_of(view, estimator, Loops::unseen);
  std::string text = estimator.id + ": torque error ";
  if (own.count == 0) {
    text += "on training loops not computed";
  } else {
    text += percent_of_peak(own.middle) + " of peak on training loops (median";
    text += own.count > 1 ? "; worst " + percent_of_peak(own.worst) + ")" : ")";
  }
  if (other.count > 0) {
    text += "; on " + std::to_string(other.count) + " held-out loops " +
            percent_of_peak(other.middle) + " (median; best " + percent_of_peak(other.best) +
            ", worst " + percent_of_peak(other.worst) + ": " + other.worst_where + ")";
  }
  return text + ".";
}

Table estimators_table(const StudyView& view) {
  Table table{
      "estimators",
      "Torque error of every estimator over the whole study, in percent of each loop's peak: on "
      "its training loops, and on the loops held out from all.",
      {{"estimator", "", 3},
       {"what it is", "", 3},
       {"training loops", "", 0},
       {"cases", "", 0},
       errors_of_signal("training, median"),
       errors_of_signal("training, worst"),
       errors_of_signal("held-out, best"),
       errors_of_signal("held-out, median"),
       errors_of_signal("held-out, worst")},
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
  return "Held-out loops: median torque error " + percent_of_peak(b.middle) + " of peak (" +
         full->id + ") against " + percent_of_peak(a.middle) + " (" + paper->id + "); worst " +
         percent_of_peak(b.worst) + " against " + percent_of_peak(a.worst) + ".";
}

/// The static regression on as many loops as the full trajectory.
const EstimatorView* static_twin(const StudyView& view, const EstimatorView& full) {
  for (const EstimatorView& one : view.estimators()) {
    if (one.is_static_regression() && one.loops == full.loops) return &one;
  }
  return nullptr;
}

/// How the gain over the paper's method divides between the model class with several loops, and
/// simulating.
std::string origin_of(const StudyView& view) {
  const EstimatorView* paper = view.paper_fit();
  const EstimatorView* full = view.full_trajectory();
  const EstimatorView* plain = full != nullptr ? static_twin(view, *full) : nullptr;
  if (paper == nullptr || plain == nullptr) return {};
  const Spread3 model = spread_of(gains_of(view, paper->id, plain->id), &Gain::torque);
  const Spread3 simulating = spread_of(gains_of(view, plain->id, full->id), &Gain::torque);
  if (!(model.median > 0.0) || !(simulating.median > 0.0)) return {};
  const bool by_model = model.median > simulating.median;
  const auto factor = [](const Spread3& s) {
    return "a factor of " + digits(s.median, 2) + " (median; " + digits(s.least, 2) + " to " +
           digits(s.most, 2) + ")";
  };
  return "Most of the gain is " +
         std::string(by_model ? "the model class and several loops" : "simulating") +
         ": within the training range, static regression (" + plain->id +
         "), of the same class on the same loops but without a differential equation, divides the "
         "paper's errors by " +
         factor(model) + "; simulating trajectories divides what remains by " + factor(simulating) +
         ".";
}

std::optional<Section> draw(const StudyView& view) {
  if (view.artefacts().cases.empty()) return std::nullopt;
  Section section{"verdict", "In short", {}};
  if (const std::string summary = summary_of(view); !summary.empty()) {
    const std::string origin = origin_of(view);
    section.add(Verdict{origin.empty() ? summary : summary + " " + origin});
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
