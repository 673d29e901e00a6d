#include "figures/verification_figures.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace flexspline::reports {
namespace {

const std::vector<std::string> kLevels = {"bitwise", "numeric", "statistical", "differs",
                                          "missing"};
constexpr std::size_t kDrawn = 40;

/// "cases" of "cases/h_even--paper--r0.json".
std::string kind_of(const ShownCheck& check) {
  return check.artefact.substr(0, std::min(check.artefact.find('/'), check.artefact.find('.')));
}

double row_of(const std::string& level) {
  return static_cast<double>(std::find(kLevels.begin(), kLevels.end(), level) - kLevels.begin());
}

}  // namespace

Figure agreement_figure(const VerificationView& view) {
  Figure figure;
  figure.id = "agreement";
  figure.kind = "scatter";
  figure.title = "How well the two runs agree";
  figure.caption =
      "Number of artefacts at each level, by kind. All of them in the first line is a run that "
      "repeats to the last bit; the second is rounding; anything below asks for a reason.";
  figure.alt = "Number of artefacts that agree bitwise, numerically, statistically, or not.";
  std::map<std::string, std::map<double, double>> counts;
  for (const ShownCheck& one : view.artefacts) ++counts[kind_of(one)][row_of(one.level)];
  Panel panel;
  panel.x.label = "artefacts";
  panel.y.label = "level";
  panel.y.categories = kLevels;
  double most = 1.0;
  int rank = 0;
  for (const auto& [kind, levels] : counts) {
    Series series{kind, "points", {"plain", rank++}, {}, {}, {}, {}};
    for (const auto& [row, count] : levels) {
      series.x.push_back(count);
      series.y.push_back(row);
      most = std::max(most, count);
    }
    panel.series.push_back(std::move(series));
  }
  panel.x.range = {0.0, std::ceil(1.05 * most)};
  if (!panel.series.empty()) figure.frames.push_back({{}, {std::move(panel)}});
  return figure;
}

Figure differences_figure(const VerificationView& view) {
  Figure figure;
  figure.id = "differences";
  figure.kind = "scatter";
  figure.title = "Largest difference of each artefact, over its tolerance";
  figure.caption =
      "Left of one is rounding. Right of one is a difference that somebody has to explain; what "
      "changed between the runs stands in the table.";
  figure.alt = "Largest difference over its tolerance of each artefact that is not the same.";
  std::vector<const ShownCheck*> unequal;
  for (const ShownCheck& one : view.artefacts) {
    if (one.over_tolerance > 0.0) unequal.push_back(&one);
  }
  std::stable_sort(unequal.begin(), unequal.end(), [](const auto* a, const auto* b) {
    return a->over_tolerance > b->over_tolerance;
  });
  unequal.resize(std::min(unequal.size(), kDrawn));
  Panel panel;
  panel.x.label = "difference / tolerance";
  panel.x.log = true;
  panel.y.label = "artefact";
  Series series{"largest difference", "points", {"plain", 0}, {}, {}, {}, {}};
  double lower = 0.1, upper = 10.0;
  for (const ShownCheck* one : unequal) {
    series.x.push_back(one->over_tolerance);
    series.y.push_back(static_cast<double>(panel.y.categories.size()));
    panel.y.categories.push_back(one->artefact);
    lower = std::min(lower, one->over_tolerance);
    upper = std::max(upper, one->over_tolerance);
  }
  if (unequal.empty()) return figure;
  panel.x.range = {std::pow(10.0, std::floor(std::log10(lower))),
                   std::pow(10.0, std::ceil(std::log10(upper)))};
  panel.marks.push_back({1.0, "the tolerance"});
  panel.series.push_back(std::move(series));
  figure.frames.push_back({{}, {std::move(panel)}});
  return figure;
}

}  // namespace flexspline::reports
