#include <algorithm>
#include <cmath>
#include <set>

#include "figures/study_figures.hpp"
#include "flexspline/reports/section.hpp"
#include "numbers.hpp"

namespace flexspline::reports {
namespace {

const AbsorbedShare* most_absorbed(const Case& item) {
  const auto most = std::max_element(
      item.absorbed.begin(), item.absorbed.end(),
      [](const auto& a, const auto& b) { return std::abs(a.cosine) < std::abs(b.cosine); });
  return most == item.absorbed.end() ? nullptr : &*most;
}

Table identifiability_table(const StudyView& view) {
  Table table{"identifiability",
              "What can be told apart on these recordings: condition of the scaled Jacobian, and "
              "the parameter that the rest of the model imitates best (cosine 1: entirely).",
              {{"input", "", 3},
               {"estimator", "", 3},
               {"verdict", "", 3},
               {"condition", "", 2},
               {"most absorbed", "", 3},
               {"by", "", 3},
               {"cosine", "", 6},
               {"in words", "", 3}},
              {}};
  for (const Input& input : view.artefacts().inputs) {
    for (const EstimatorView& estimator : view.estimators()) {
      const Case* item = view.find(input, estimator);
      if (item == nullptr || item->failed) continue;
      const AbsorbedShare* most = most_absorbed(*item);
      table.rows.push_back({input.title, estimator.id, item->verdict, item->condition,
                            most != nullptr ? most->parameter : "", most != nullptr ? most->by : "",
                            most != nullptr ? most->cosine : kAbsent, item->says});
    }
  }
  return table;
}

Table parameter_table(const StudyView& view, const Input& input) {
  Table table{"parameters-" + slug(input.id),
              "Parameters on " + input.title + " with standard deviations and 95 % intervals.",
              {{"estimator", "", 3},
               {"parameter", "", 3},
               {"value", "", 5},
               {"std", "", 2},
               {"from", "", 5},
               {"to", "", 5},
               {"unit", "", 3},
               {"on a bound", "", 3}},
              {}};
  for (const EstimatorView& estimator : view.estimators()) {
    const Case* item = view.find(input, estimator);
    if (item == nullptr) continue;
    for (const Parameter& p : item->parameters) {
      table.rows.push_back({estimator.id, p.name, p.value, p.std, p.lower, p.upper, p.unit,
                            p.bound_active ? "yes" : ""});
    }
  }
  return table;
}

Table convergence_table(const StudyView& view) {
  Table table{"convergence",
              "How each fit ended: cost is half the sum of squared weighted residuals.",
              {{"input", "", 3},
               {"estimator", "", 3},
               {"ended", "", 3},
               {"evaluations", "", 0},
               {"cost", "", 4}},
              {}};
  for (const Input& input : view.artefacts().inputs) {
    for (const EstimatorView& estimator : view.estimators()) {
      const Case* item = view.find(input, estimator);
      if (item == nullptr) continue;
      table.rows.push_back({input.title, estimator.id, item->failed ? "failed" : item->termination,
                            item->evaluations, item->cost});
    }
  }
  return table;
}

bool refuses_h(const Case& item) {
  return item.band("h") == nullptr &&
         (item.verdict == "weak" || item.verdict == "not_identifiable");
}

bool doubts_h(const Case& item) { return item.band("h") != nullptr && item.verdict == "weak"; }

/// Each reason once, with the estimators it holds for.
void add_reasons(const StudyView& view, Section& section) {
  std::set<std::string> told;
  for (const Input& input : view.artefacts().inputs) {
    for (const EstimatorView& estimator : view.estimators()) {
      const Case* item = view.find(input, estimator);
      if (item == nullptr || item->failed || item->says.empty()) continue;
      if (!refuses_h(*item) && !doubts_h(*item)) continue;
      const std::string whose =
          (item->verdict == "weak" ? "Weak: h from " : "No h from ") + estimator.id;
      if (!told.insert(whose).second) continue;
      section.add(Paragraph{whose + " on " + input.title + ": " + item->says});
    }
  }
}

std::string verdict_of(const StudyView& view) {
  std::size_t with_h = 0, done = 0, refused = 0, doubted = 0;
  for (const Case& item : view.artefacts().cases) {
    if (item.failed) continue;
    ++done;
    if (item.band("h") != nullptr) ++with_h;
    if (refuses_h(item)) ++refused;
    if (doubts_h(item)) ++doubted;
  }
  std::string text = "Of " + std::to_string(done) + (done == 1 ? " fit, " : " fits, ") +
                     std::to_string(with_h) + " would make h identifiable beside f and g⁻¹";
  if (doubted > 0) {
    text +=
        ", " + std::to_string(doubted) + " of them with a class of h that is not the recordings'";
  }
  if (refused == 0) return text + (doubted > 0 ? "; the reasons are below." : ".");
  return text + "; in " + std::to_string(refused) +
         " the method or its recordings do not determine h, and the reasons are below.";
}

std::optional<Section> draw(const StudyView& view) {
  if (view.artefacts().cases.empty() || view.artefacts().inputs.empty()) return std::nullopt;
  Section section{"functions-section", "How sure are f, g and h?", {}};
  section.add(Verdict{verdict_of(view)});
  Figure figure = function_figure(view);
  if (!figure.frames.empty()) section.add(std::move(figure));
  add_reasons(view, section);
  section.fold("What can be told apart: condition and absorbed directions",
               identifiability_table(view));
  for (const Input& input : view.artefacts().inputs) {
    Table table = parameter_table(view, input);
    if (!table.rows.empty()) section.fold("Parameters with 95 % intervals", std::move(table));
  }
  if (Figure work = convergence_figure(view); !work.frames.empty()) {
    section.fold("Convergence: how each fit ended", std::move(work));
  }
  section.fold("Convergence: how each fit ended", convergence_table(view));
  return section;
}

}  // namespace

SectionRow describe_functions() { return {40, draw}; }

}  // namespace flexspline::reports
