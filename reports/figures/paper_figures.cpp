#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>
#include <utility>

#include "decimated.hpp"
#include "extent.hpp"
#include "figures/study_figures.hpp"
#include "numbers.hpp"

namespace flexspline::reports {
namespace {

constexpr double kAmplitudeDeg = 0.2;  ///< 10 deg at the motor, ratio 50
constexpr double kFrequencyHz = 0.005;

/// Coefficients c1, c2, ... of an odd polynomial out of Table I.
std::vector<double> coefficients(const Paper& paper, char letter) {
  std::vector<double> found;
  for (int i = 1; i <= 5; ++i) {
    const std::string name = letter + std::to_string(i);
    const auto row = std::find_if(paper.table_1.begin(), paper.table_1.end(),
                                  [&](const TableOneRow& item) { return item.name == name; });
    if (row == paper.table_1.end() || !std::isfinite(row->published)) return {};
    found.push_back(row->published);
  }
  return found;
}

double odd_polynomial(const std::vector<double>& c, double x) {
  double value = 0.0;
  for (std::size_t i = c.size(); i-- > 0;) value = value * x * x + c[i];
  return value * x;
}

/// Names that artefacts spell out, as a reader of the paper knows them.
std::string typeset(std::string text) {
  const std::pair<std::string_view, std::string_view> spelt[] = {
      {"g^-1", "g⁻¹"}, {"phi'", "φ′"}, {"phi", "φ"}, {"theta_1", "θ₁"}, {"tau", "τ"}};
  for (const auto& [plain, symbol] : spelt) {
    for (std::size_t at = 0; (at = text.find(plain, at)) != std::string::npos;) {
      text.replace(at, plain.size(), symbol);
      at += symbol.size();
    }
  }
  return text;
}

Panel beyond_panel(const std::vector<double>& c, double range, const std::string& title,
                   const std::string& x_label, const std::string& y_label) {
  Panel panel;
  panel.title = title;
  panel.x.label = x_label;
  panel.y.label = y_label;
  Series inside{"on the fitted loop", "line", {"published", 0}, {}, {}, {}, {}};
  Series beyond{"beyond it", "line", {"estimator", 0}, {}, {}, {}, {}};
  double peak = 0.0;
  for (int i = 0; i <= 200; ++i) {
    const double x = 1.5 * range * i / 200.0;
    const double y = odd_polynomial(c, x);
    Series& part = x <= range * (1.0 + 1e-9) ? inside : beyond;
    if (&part == &inside) peak = std::max(peak, std::abs(y));
    if (&part == &beyond && beyond.x.empty()) {
      beyond.x.push_back(inside.x.back());
      beyond.y.push_back(inside.y.back());
    }
    part.x.push_back(x);
    part.y.push_back(y);
  }
  panel.series = {std::move(inside), std::move(beyond)};
  panel.marks = {{rounded(range, 4), "end of the fitted loop"}};
  panel.y.range = widened(-3.0 * peak, 2.0 * peak, 0.05);
  return panel;
}

/// The full trajectory's estimate on recordings of Table I.
const Case* full_on_table_one(const StudyView& view) {
  const EstimatorView* full = view.full_trajectory();
  if (full == nullptr) return nullptr;
  for (const Input& input : view.artefacts().inputs) {
    if (input.truth_id == "table_i") return view.find(input, *full);
  }
  return nullptr;
}

/// As far as the panel's own first series reaches.
void add_within(Panel& panel, const std::string& name, const std::vector<double>& x,
                const std::vector<double>& y) {
  const auto& shown = panel.series.front().x;
  const auto [first, last] = std::minmax_element(shown.begin(), shown.end());
  Series series{name, "line", {"plain", 3}, {}, {}, {}, {}};
  for (std::size_t i = 0; i < std::min(x.size(), y.size()); ++i) {
    if (x[i] < 1.001 * *first - 1e-9 || x[i] > 1.001 * *last) continue;
    series.x.push_back(x[i]);
    series.y.push_back(y[i]);
  }
  if (!series.x.empty()) panel.series.push_back(std::move(series));
}

/// To what the paper calls estimated, what its own recordings give along whole trajectories.
void add_full_trajectory(const StudyView& view, const PaperFigure& from, Panel& panel) {
  const Case* full = full_on_table_one(view);
  if (full == nullptr || panel.series.empty()) return;
  if (from.id == "figure_10" || from.id == "figure_11") {
    const Band* band = full->band(from.id == "figure_10" ? "f" : "g_inverse");
    if (band != nullptr) add_within(panel, "full trajectory", band->argument, band->value);
  }
  if (from.id == "figure_12" && !full->train.empty()) {
    const CaseRecording* loop = full->recording(full->train.front());
    if (loop != nullptr) add_within(panel, "full trajectory", loop->motion, loop->simulated);
  }
}

Role role_in(const std::string& side, const PaperSeries& series, int rank) {
  if (side == "paper") return {"published", 0};
  if (series.points || series.name == "measured") return {"measured", 0};
  return {"plain", rank};
}

/// Two sides are compared on the same axes.
void share_axes(std::vector<Panel>& panels) {
  if (panels.size() < 2) return;
  for (const bool along_x : {true, false}) {
    Extent extent;
    for (const Panel& panel : panels) {
      for (const Series& series : panel.series) extent.take(along_x ? series.x : series.y);
    }
    for (Panel& panel : panels) {
      (along_x ? panel.x : panel.y).range = widened(extent.lower, extent.upper, 0.04);
    }
  }
}

Panel side_panel(const PaperFigure& from, const std::string& side) {
  Panel panel;
  panel.title = side == "paper" ? "as printed" : side;
  panel.x.label = typeset(from.x_label);
  panel.y.label = typeset(from.y_label);
  int rank = 0;
  for (const PaperSeries& series : from.series) {
    if (series.side != side) continue;
    panel.series.push_back({series.name,
                            series.points ? "points" : "line",
                            role_in(side, series, rank++),
                            series.x,
                            series.y,
                            {},
                            {}});
    if (!series.points) decimate(panel.series.back().x, panel.series.back().y, 2000);
  }
  return panel;
}

}  // namespace

Figure table_one_figure(const Paper& paper) {
  Figure figure;
  const auto a = coefficients(paper, 'a');
  const auto b = coefficients(paper, 'b');
  if (a.empty() || b.empty()) return figure;
  figure.id = "table-one-beyond";
  figure.title = "Table I's functions to 1.5 times the range they were fitted on";
  figure.caption =
      "Both turn round soon after the fitted loop ends and then change sign: from there the model "
      "makes energy. Strict monotonicity, on which existence and uniqueness rest, holds on the "
      "training loop only.";
  figure.alt = "Table I's f and g⁻¹ rise to the end of the fitted range, then fall below zero.";
  const double rate = 2.0 * std::numbers::pi * kFrequencyHz * kAmplitudeDeg;
  figure.frames.push_back({{},
                           {beyond_panel(a, kAmplitudeDeg, "f", "torsion / deg", "f / Nm"),
                            beyond_panel(b, rate, "g⁻¹", "torsion rate / (deg/s)", "g⁻¹ / Nm")}});
  return figure;
}

Figure paper_figure(const StudyView& view, const PaperFigure& from) {
  Figure figure;
  figure.id = slug(from.id);
  const std::string number = from.id.starts_with("figure_") ? from.id.substr(7) : std::string{};
  figure.title = number.empty() ? from.title : "Figure " + number + ": " + from.title;
  figure.caption = typeset(from.says);
  if (!from.wrong.empty()) figure.caption += " What is wrong: " + typeset(from.wrong);
  figure.alt = from.title + ": " + from.y_label + " over " + from.x_label + ".";
  Frame frame;
  for (const char* side : {"", "paper", "ours"}) {
    Panel panel = side_panel(from, side);
    if (side == std::string_view("ours")) add_full_trajectory(view, from, panel);
    if (!panel.series.empty()) frame.panels.push_back(std::move(panel));
  }
  if (from.id != "figure_7") share_axes(frame.panels);  // one cycle there, five here
  figure.frames.push_back(std::move(frame));
  return figure;
}

}  // namespace flexspline::reports
