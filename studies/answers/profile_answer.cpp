#include "answers/profile_answer.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "answers/kind_parts.hpp"
#include "answers/profile_likelihood.hpp"
#include "flexspline/studies/study_rows.hpp"

namespace flexspline::studies {
namespace {

constexpr std::size_t kMostPanels = 12;

/// The fits of one estimator on one input.
struct Fits {
  double cost = std::nan("");
  double freedom = 0.0;  ///< residuals less parameters
  std::vector<CaseRow::Parameter> parameters;
  std::map<std::string, std::vector<HeldFit>> held;  ///< rise: the cost, as yet
};

bool is_free(const EstimatorConfig& estimator) { return estimator.id.ends_with(kFreeFit); }

void enter(const CasePlan& one, const CaseRow& row, Fits& fits) {
  if (is_free(*one.estimator)) {
    fits.cost = row.number("cost");
    fits.freedom = residuals_of(one, row) - row.number("parameters");
    fits.parameters = row.parameters;
    return;
  }
  const CaseRow::Parameter& held = row.parameters.back();
  fits.held[held.name].push_back({held.value, row.number("cost")});
}

std::optional<ProfileLikelihood> profile_of(const Fits& fits, const CaseRow::Parameter& parameter,
                                            bool& below) {
  const auto held = fits.held.find(parameter.name);
  if (held == fits.held.end() || !(fits.cost > 0.0) || !(fits.freedom > 0.0)) return std::nullopt;
  ProfileInput input{parameter.value, parameter.std, held->second};
  for (HeldFit& one : input.held) {
    one.rise = fits.freedom * (one.rise / fits.cost - 1.0);
    below = below || one.rise < -1e-3 * kProfileRise;
  }
  std::erase_if(input.held, [](const HeldFit& one) { return std::isnan(one.rise); });
  return ProfileLikelihood(input);
}

AnswerPanel panel_of(const std::string& title, const CaseRow::Parameter& parameter,
                     const ProfileLikelihood& profile) {
  AnswerPanel panel;
  panel.title = title;
  panel.x_label = parameter.name + (parameter.unit.empty() ? "" : " / " + parameter.unit);
  panel.y_label = "rise of -2 ln L";
  constexpr int kPoints = 60;
  const auto beyond = [&](std::optional<double> crossing, double end) {
    if (!crossing) return end;
    const double far = parameter.value + 1.6 * (*crossing - parameter.value);
    return *crossing < parameter.value ? std::max(end, far) : std::min(end, far);
  };
  const double from = beyond(profile.lower(), profile.first());
  const double to = beyond(profile.upper(), profile.last());
  AnswerSeries own{"profile", "line", {}, {}};
  AnswerSeries parabola{"its covariance's parabola", "line", {}, {}};
  AnswerSeries limit{"95 %", "line", {}, {}};
  for (int k = 0; k <= kPoints; ++k) {
    const double x = from + (to - from) * k / kPoints;
    own.x.push_back(x);
    own.y.push_back(profile.rise(x));
    limit.x.push_back(x);
    limit.y.push_back(kProfileRise);
    const double z = (x - parameter.value) / parameter.std;
    if (!(z * z < 4.0 * kProfileRise)) continue;
    parabola.x.push_back(x);
    parabola.y.push_back(z * z);
  }
  panel.series = {std::move(own), std::move(parabola), std::move(limit)};
  return panel;
}

std::variant<std::string, double> edge_of(std::optional<double> at) {
  return at ? std::variant<std::string, double>(*at) : "none";
}

AnswerTable empty_table() {
  return {"profile",
          "95 % intervals by profile and by covariance; \"none\": the profile stays below 3.84 up "
          "to the last held value. Widening: over independent noise",
          {"case", "parameter", "unit", "estimate", "profile from", "profile to", "covariance from",
           "covariance to", "widening"},
          {}};
}

/// What the fits of one case say: rows, panels, and a part of the sentence.
void add_case(const std::string& name, const Fits& fits, AnswerTable& table, AnswerFigure& figure,
              KindAnswer& answer) {
  std::vector<std::string> open;
  std::size_t profiled = 0;
  bool below = false;
  for (const CaseRow::Parameter& one : fits.parameters) {
    const auto profile = profile_of(fits, one, below);
    if (!profile) continue;
    ++profiled;
    table.rows.push_back({name, one.name, one.unit, one.value, edge_of(profile->lower()),
                          edge_of(profile->upper()), one.value - 1.96 * one.std,
                          one.value + 1.96 * one.std, profile->widening()});
    if (!profile->lower() || !profile->upper()) open.push_back(one.name);
    if (figure.panels.size() < kMostPanels) figure.panels.push_back(panel_of(name, one, *profile));
  }
  if (profiled == 0) return;
  answer.says +=
      fmt::format("{}{}: {} of {} parameters are bounded on both sides",
                  answer.says.empty() ? "" : "; ", name, profiled - open.size(), profiled);
  if (!open.empty()) answer.says += fmt::format(", not {}", fmt::join(open, ", "));
  if (!below) return;
  answer.notes.push_back(name +
                         ": with a parameter held the cost is below that of the free fit, which is "
                         "not the minimum then: give it more starts.");
}

}  // namespace

KindAnswer answer_profiles(const StudyRows& rows) {
  std::map<std::string, Fits> found;
  rows.each([&](const CasePlan& one, const CaseRow& row) {
    if (one.replicate > 0) return;
    enter(one, row, found[fmt::format("{}, {}", one.input->id, one.estimator->written_id())]);
  });
  KindAnswer answer;
  AnswerTable table = empty_table();
  AnswerFigure figure{"profile",
                      "Profile likelihoods",
                      "Rise of -2 ln L with one parameter held and all others fitted. An interval "
                      "is where it stays below the line; a profile that stays below it is no "
                      "evidence for either side.",
                      "",
                      {}};
  for (const auto& [name, fits] : found) add_case(name, fits, table, figure, answer);
  answer.says += answer.says.empty() ? "No fit of all parameters gave a result." : ".";
  answer.figures.push_back(std::move(figure));
  answer.tables.push_back(std::move(table));
  return answer;
}

}  // namespace flexspline::studies
