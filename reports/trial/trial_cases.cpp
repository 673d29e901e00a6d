#include <algorithm>

#include "flexspline/reports/trial_view.hpp"
#include "numbers.hpp"

namespace flexspline::reports {
namespace {

template <class T, class Show>
std::string joined(const std::vector<T>& list, Show show) {
  std::string text;
  for (const T& one : list) text += (text.empty() ? "" : " + ") + show(one);
  return text;
}

std::string answer_of(const ShownTrialCase& one) {
  if (!one.failure.empty()) return "failed: " + one.failure;
  const std::string named = joined(one.named, words);
  return named.empty() ? words(one.verdict) : words(one.verdict) + ": " + named;
}

std::string percent(double share) { return digits(100.0 * share, 2); }

std::vector<Cell> row_of(const ShownTrialCase& one) {
  const std::string hidden = joined(one.effects, words);
  return {one.key,
          one.rig,
          hidden.empty() ? "nothing" : hidden,
          joined(one.size, percent),
          joined(one.trace, percent),
          answer_of(one),
          one.right ? "yes" : "no",
          one.after_over_noise,
          one.seconds};
}

Table cases_table(const std::string& id, const std::string& caption,
                  const std::vector<const ShownTrialCase*>& cases) {
  Table table{id,
              caption,
              {{"case", "", 3},
               {"rig", "", 3},
               {"hidden", "", 3},
               {"size", "%", 2},
               {"trace", "%", 2},
               {"answer", "", 3},
               {"right", "", 3},
               {"hold-out over noise", "", 3},
               {"took", "s", 2}},
              {}};
  for (const ShownTrialCase* one : cases) table.rows.push_back(row_of(*one));
  return table;
}

std::optional<Section> draw(const TrialView& view) {
  if (view.cases.empty()) return std::nullopt;
  Section section{"cases-section", "Case by case: the truth and the answer", {}};
  std::vector<const ShownTrialCase*> all, wrong;
  for (const ShownTrialCase& one : view.cases) {
    all.push_back(&one);
    if (!one.right) wrong.push_back(&one);
  }
  section.add(Verdict{std::to_string(all.size() - wrong.size()) + " of " +
                      std::to_string(all.size()) + " answers are right in full."});
  if (!wrong.empty()) {
    section.add(cases_table("trial-wrong", "Those that are not.", wrong));
  }
  section.fold("Every case", cases_table("trial-cases", "Every case, unsealed.", all));
  return section;
}

}  // namespace

TrialSectionRow describe_trial_cases() { return {30, draw}; }

}  // namespace flexspline::reports
