#include "figures/trial_figures.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "numbers.hpp"

namespace flexspline::reports {
namespace {

struct Rate {
  const char* name;
  const char* title;
};

constexpr Rate kRates[] = {
    {"null_ok", "nothing hidden, called adequate"},
    {"single_top", "one effect, named first"},
    {"single_exact", "one effect, named exactly"},
    {"pair_all", "two effects, both named"},
    {"pair_one", "two effects, at least one named"},
    {"unknown_unnamed", "outside the catalogue, not named"},
    {"unknown_ok", "the same, and called unexplained"},
    {"contained_ok", "contained in the baseline, no false name"},
    {"incident_ok", "burst, step or glitch, its place told"},
    {"incident_unnamed", "the same, given no name"},
    {"coord_ok", "right coordinate among three"},
    {"false_name", "cases with a false name"},
    {"single_exact_or_alternative", "one effect, or an alternative, exactly"},
    {"pair_all_or_alternative", "two effects, or alternatives, both"},
    {"contained_ok_or_alternative", "contained, or an alternative, no false name"},
    {"false_name_and_alternatives", "false names, alternatives counting too"}};

/// What no catalogue has, and what happened inside one recording.
bool is_unnamed(const std::string& label) {
  return label.starts_with("unknown:") || label.starts_with("incident:");
}

/// Places of what is no effect: rows and columns that belong together stand at the same end.
int rank_of(const std::string& label) {
  if (label == "nothing" || label == "adequate") return -2;
  if (label == "contained in the baseline") return -1;
  if (label == "two effects" || label == "one of the two") return 1;
  if (is_unnamed(label) || label == "no name") return 2;
  return label == "failed" ? 3 : 0;
}

std::vector<std::string> labels_of(const std::set<std::string>& names) {
  std::vector<std::string> labels(names.begin(), names.end());
  std::stable_sort(labels.begin(), labels.end(),
                   [](const auto& a, const auto& b) { return rank_of(a) < rank_of(b); });
  return labels;
}

bool is_right(const ShownConfusion& one) {
  if (one.truth == "nothing") return one.named == "adequate";
  if (one.truth == "contained in the baseline" && one.named == "adequate") return true;
  if (is_unnamed(one.truth)) return one.named == "no name";
  return one.truth == one.named;
}

int index_in(const std::vector<std::string>& labels, const std::string& name) {
  return static_cast<int>(std::find(labels.begin(), labels.end(), name) - labels.begin());
}

std::vector<std::string> in_words(std::vector<std::string> labels) {
  for (std::string& label : labels) label = words(label);
  return labels;
}

Panel detection_panel(const char* label, const std::vector<ShownDetectionBin>& bins) {
  Panel panel;
  panel.x.label = label;
  panel.y.label = "cases / %";
  panel.y.range = {0.0, 105.0};
  panel.series = {{"detected", "line", {"plain", 0}, {}, {}, {}, {}},
                  {"named first", "line", {"plain", 1}, {}, {}, {}, {}},
                  {"named exactly", "line", {"plain", 2}, {}, {}, {}, {}}};
  for (const ShownDetectionBin& bin : bins) {
    if (!(bin.cases > 0.0)) continue;
    const double middle = std::isfinite(bin.to) ? 0.5 * (bin.from + bin.to) : bin.from;
    const double counts[] = {bin.detected, bin.first_right, bin.exact};
    for (std::size_t i = 0; i < panel.series.size(); ++i) {
      panel.series[i].x.push_back(100.0 * middle);
      panel.series[i].y.push_back(100.0 * counts[i] / bin.cases);
    }
  }
  return panel;
}

}  // namespace

std::string rate_title(const std::string& name) {
  for (const Rate& rate : kRates) {
    if (name == rate.name) return rate.title;
  }
  return words(name);
}

std::vector<std::pair<std::string, ShownRate>> told_rates(const ShownScores& scores) {
  std::vector<std::pair<std::string, ShownRate>> told;
  for (const Rate& rate : kRates) {
    const ShownRate found = scores.rate(rate.name);
    if (found.of > 0.0) told.emplace_back(rate.name, found);
  }
  return told;
}

Figure rates_figure(const TrialView& view) {
  Figure figure;
  figure.id = "rates";
  figure.kind = "scatter";
  figure.title = "How often it was right";
  figure.caption =
      "Symbols are shares of cases, lines their 95 % intervals (Wilson). False names are to be "
      "few, the others near 100 %. A wide line means few cases, not a bad diagnosis.";
  figure.alt = "Rates of the trial with their 95 % intervals.";
  Panel panel;
  panel.x.label = "cases / %";
  panel.x.range = {0.0, 100.0};
  panel.y.label = "question";
  Series intervals{"95 % interval", "line", {"plain", 0}, {}, {}, {}, {}};
  Series rates{"share of cases", "points", {"plain", 0}, {}, {}, {}, {}};
  Series seen{"of those that can be seen", "points", {"plain", 1}, {}, {}, {}, {}};
  for (const auto& [name, rate] : told_rates(view.scores)) {
    const auto row = static_cast<double>(panel.y.categories.size());
    panel.y.categories.push_back(rate_title(name));
    rates.x.push_back(100.0 * rate.rate);
    rates.y.push_back(row);
    if (const ShownRate one = view.scores_seen.rate(name); one.of > 0.0) {
      seen.x.push_back(100.0 * one.rate);
      seen.y.push_back(row);
    }
    intervals.x.insert(intervals.x.end(), {100.0 * rate.lower, 100.0 * rate.upper, kAbsent});
    intervals.y.insert(intervals.y.end(), {row, row, kAbsent});
  }
  if (rates.x.empty()) return figure;
  panel.series = {std::move(rates), std::move(intervals)};
  if (!seen.x.empty()) panel.series.push_back(std::move(seen));
  figure.frames.push_back({{}, {std::move(panel)}});
  return figure;
}

Figure reliability_figure(const TrialView& view) {
  Figure figure;
  figure.id = "reliability";
  figure.kind = "scatter";
  figure.title = "How reliable a printed probability is";
  figure.caption =
      "Of the names given with about this probability, the share that was right, with its 95 % "
      "interval. On the line, of the names given at p, p are right; below it, names are given with "
      "more confidence than they deserve.";
  figure.alt = "Share of right names over their printed probability.";
  Panel panel;
  panel.x = {"printed probability / %", false, {}, std::pair{0.0, 101.0}};
  panel.y = {"right / %", false, {}, std::pair{0.0, 101.0}};
  Series ideal{"as printed", "line", {"plain", 1}, {0.0, 100.0}, {0.0, 100.0}, {}, {}};
  Series shares{"names", "points", {"plain", 0}, {}, {}, {}, {}};
  Series intervals{"95 % interval", "line", {"plain", 0}, {}, {}, {}, {}};
  for (const ShownReliabilityBin& bin : view.reliability) {
    const double p = 100.0 * bin.mean_probability;
    shares.x.push_back(p);
    shares.y.push_back(100.0 * bin.right.rate);
    intervals.x.insert(intervals.x.end(), {p, p, kAbsent});
    intervals.y.insert(intervals.y.end(),
                       {100.0 * bin.right.lower, 100.0 * bin.right.upper, kAbsent});
  }
  if (shares.x.empty()) return figure;
  panel.series = {std::move(shares), std::move(intervals), std::move(ideal)};
  figure.frames.push_back({{}, {std::move(panel)}});
  return figure;
}

Figure confusion_figure(const TrialView& view) {
  Figure figure;
  figure.id = "confusion";
  figure.kind = "heatmap";
  figure.title = "What was hidden, and what was named first";
  figure.caption =
      "Numbers are cases; those in a row hid the same thing, columns are the first name given. A "
      "tick marks the right answer; what stands beside it is what it was taken for. Of two effects "
      "a first name can only be one.";
  figure.alt = "Confusion matrix: hidden effect by row, first name by column, number of cases.";
  figure.cell_unit = "cases";
  std::set<std::string> truths, names;
  double most = 1.0;
  for (const ShownConfusion& one : view.confusion) {
    truths.insert(one.truth);
    names.insert(one.named);
    if (rank_of(one.truth) == 0) names.insert(one.truth);
    if (rank_of(one.named) == 0) truths.insert(one.named);
    most = std::max(most, one.count);
  }
  std::vector<std::string> rows = labels_of(truths);
  std::reverse(rows.begin(), rows.end());  // the first one is drawn at the bottom
  const std::vector<std::string> columns = labels_of(names);
  Panel panel;
  panel.x = {"named first", false, in_words(columns), {}};
  panel.y = {"hidden", false, in_words(rows), {}};
  for (const ShownConfusion& one : view.confusion) {
    panel.cells.push_back({index_in(columns, one.named), index_in(rows, one.truth), one.count,
                           is_right(one) ? "right" : ""});
  }
  figure.scale = {1.0, std::pow(10.0, std::max(1.0, std::ceil(std::log10(most))))};
  if (!panel.cells.empty()) figure.frames.push_back({{}, {std::move(panel)}});
  return figure;
}

Figure detection_figure(const TrialView& view) {
  Figure figure;
  figure.id = "detection";
  figure.title = "Single effects by their size, and by their trace";
  figure.caption =
      "How large an effect has to be before it is seen, and before it is named. The trace is what "
      "the fitted baseline leaves of it: of a compliance in series next to nothing, whatever its "
      "size. Where the lines part, something is noticed that cannot yet be told.";
  figure.alt =
      "Share of single effects detected, named first and named exactly, over their size and over "
      "their trace.";
  std::vector<Panel> panels;
  if (!view.by_size.empty()) {
    panels.push_back(detection_panel("size of the effect / % of peak torque", view.by_size));
  }
  if (!view.by_trace.empty()) {
    panels.push_back(detection_panel("trace of the effect / % of peak torque", view.by_trace));
  }
  if (!panels.empty()) figure.frames.push_back({{}, std::move(panels)});
  return figure;
}

}  // namespace flexspline::reports
