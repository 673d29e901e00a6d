#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <boost/math/distributions/beta.hpp>
#include <boost/math/distributions/chi_squared.hpp>

#include "answers/kind_tables.hpp"
#include "flexspline/studies/kind.hpp"
#include "flexspline/studies/study_rows.hpp"

namespace flexspline::studies {
namespace {

constexpr double kTail = 0.025;  // of a 95 % interval, either side

void read(TomlSection& own, StudyConfig& study) {
  need_truths(own, study);
  study.settings.numbers["ranks"] = static_cast<double>(own.integer("ranks", 2, 100).value_or(20));
  if (study.replicates < 2) {
    own.refuse("", "a study of kind coverage with one replicate covers nothing",
               "write replicates = 200 at the top of the file");
  }
}

/// What became of one function of one estimator: a rank each, by simulation-based calibration.
struct Calibration {
  std::vector<double> pits;       ///< all probes of all replicates
  std::vector<std::size_t> fits;  ///< number of the fit each belongs to, for counting
  std::size_t cases = 0;
};

struct Share {
  double value = 0.0, lower = 0.0, upper = 1.0;
};

/// Share with Clopper and Pearson's 95 % interval.
Share share_of(double hits, double of) {
  using Beta = boost::math::beta_distribution<>;
  Share share{hits / of, 0.0, 1.0};
  if (hits > 0.0) share.lower = quantile(Beta(hits, of - hits + 1.0), kTail);
  if (hits < of) share.upper = quantile(Beta(hits + 1.0, of - hits), 1.0 - kTail);
  return share;
}

std::vector<double> histogram(const std::vector<double>& pits, std::size_t bins) {
  std::vector<double> counts(bins, 0.0);
  for (const double pit : pits) {
    const auto bin = static_cast<std::size_t>(pit * static_cast<double>(bins));
    counts[std::min(bin, bins - 1)] += 1.0;
  }
  return counts;
}

AnswerPanel ranks_panel(const std::string& title, const std::vector<double>& counts, double total) {
  AnswerPanel panel;
  panel.title = title;
  panel.x_label = "rank of the truth, 0 to 1";
  panel.y_label = "share of the fits / %";
  const auto bins = static_cast<double>(counts.size());
  AnswerSeries seen{"seen", "points", {}, {}};
  AnswerSeries wanted{"calibrated, 95 %", "band", {}, {}, {}, {}};
  const double width = 196.0 * std::sqrt((1.0 - 1.0 / bins) / (bins * total));
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const double x = (static_cast<double>(i) + 0.5) / bins;
    seen.x.push_back(x);
    seen.y.push_back(100.0 * counts[i] / total);
    wanted.x.push_back(x);
    wanted.y.push_back(100.0 / bins);
    wanted.lower.push_back(std::max(0.0, 100.0 / bins - width));
    wanted.upper.push_back(100.0 / bins + width);
  }
  AnswerSeries level{wanted.name, "line", wanted.x, wanted.y};
  panel.series = {std::move(wanted), std::move(level), std::move(seen)};
  return panel;
}

KindAnswer answer(const StudyRows& rows) {
  const auto bins = static_cast<std::size_t>(rows.study().settings.numbers.at("ranks"));
  std::map<std::pair<std::string, std::string>, Calibration> found;
  rows.each([&](const CasePlan& one, const CaseRow& row) {
    for (const auto& [name, pits] : row.lists) {
      if (!name.starts_with("pit_") || pits.empty()) continue;
      Calibration& to = found[{one.estimator->id, name.substr(4)}];
      ++to.cases;
      // One probe a fit, another one from fit to fit, so that no two ranks come from one fit.
      to.pits.push_back(pits[to.cases % pits.size()]);
    }
  });
  KindAnswer answer;
  AnswerFigure figure{
      "ranks",
      "Where the truth lies in the bands",
      "Rank of the truth in each fit's own distribution, one probe a fit. Level "
      "within the band: calibrated; heaped at both ends: too narrow; at the centre: "
      "too wide.",
      "",
      {}};
  AnswerTable table{
      "coverage",
      "How often a 95 % band holds the truth",
      {"estimator", "function", "fits", "covered / %", "from / %", "to / %", "p of level ranks"},
      {}};
  bool all = !found.empty();
  for (const auto& [who, calibration] : found) {
    const auto& [estimator, function] = who;
    const auto fits = static_cast<double>(calibration.pits.size());
    const auto hits = static_cast<double>(std::ranges::count_if(
        calibration.pits, [](double pit) { return pit >= kTail && pit <= 1.0 - kTail; }));
    const Share covered = share_of(hits, fits);
    const auto counts = histogram(calibration.pits, bins);
    double chi = 0.0;
    const double each = fits / static_cast<double>(bins);
    for (const double count : counts) chi += (count - each) * (count - each) / each;
    const double p = cdf(
        complement(boost::math::chi_squared_distribution<>(static_cast<double>(bins) - 1.0), chi));
    table.rows.push_back({estimator, function, fits, 100.0 * covered.value, 100.0 * covered.lower,
                          100.0 * covered.upper, p});
    figure.panels.push_back(ranks_panel(estimator + ", " + function, counts, fits));
    const bool holds = covered.lower <= 0.95 && covered.upper >= 0.95;
    all = all && holds;
    if (!holds) {
      answer.says +=
          fmt::format("{}the 95 % band of {} by {} holds the truth in {:.0f} % [{:.0f}, {:.0f}]",
                      answer.says.empty() ? "Not calibrated: " : "; ", function, estimator,
                      100.0 * covered.value, 100.0 * covered.lower, 100.0 * covered.upper);
    }
  }
  if (found.empty()) answer.says = "No estimate prints a band whose truth is known";
  if (all) answer.says = "Every 95 % band holds the truth as often as it says, within chance";
  answer.says += ".";
  answer.figures.push_back(std::move(figure));
  answer.tables.push_back(std::move(table));
  return answer;
}

}  // namespace

KindRow describe_coverage() {
  return {.id = "coverage",
          .summary = "do 95 % bands hold the truth in 95 % of repeated experiments",
          .cases = "inputs x estimators x replicates, each with noise of its own",
          .question = "Do the intervals mean what they say?",
          .read = read,
          .answer = answer};
}

}  // namespace flexspline::studies
