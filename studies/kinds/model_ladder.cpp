#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "answers/kind_parts.hpp"
#include "answers/kind_tables.hpp"
#include "comparison/middle_of.hpp"
#include "flexspline/studies/kind.hpp"
#include "flexspline/studies/study_rows.hpp"

namespace flexspline::studies {
namespace {

constexpr std::string_view kBaseline = "baseline";
constexpr std::size_t kMostRungs = 200;

/// The model with these of its effects alone, and what of hold and free is still about it.
estimators::GivenModel with_effects(const estimators::GivenModel& given,
                                    const std::vector<std::size_t>& chosen) {
  estimators::GivenModel made = given;
  made.model.effects.clear();
  for (const std::size_t one : chosen) made.model.effects.push_back(given.model.effects[one]);
  const auto gone = [&](const std::string& entry) {
    const std::string head = entry.substr(0, entry.find('.'));
    const auto is = [&](const EffectSpec& effect) { return effect.effect == head; };
    return std::ranges::any_of(given.model.effects, is) &&
           std::ranges::none_of(made.model.effects, is);
  };
  std::erase_if(made.hold, gone);
  std::erase_if(made.free, gone);
  return made;
}

std::string rung_name(const estimators::GivenModel& given, const std::vector<std::size_t>& chosen) {
  std::vector<std::string> names;
  for (const std::size_t one : chosen) names.push_back(given.model.effects[one].effect);
  return names.empty() ? std::string(kBaseline) : fmt::format("{}", fmt::join(names, "_and_"));
}

/// From none of the model's effects to so many of them at once.
std::vector<std::vector<std::size_t>> rungs_of(std::size_t effects, std::size_t most) {
  std::vector<std::vector<std::size_t>> rungs = {{}};
  for (std::size_t begin = 0, size = 1; size <= most; ++size) {
    const std::size_t end = rungs.size();
    for (; begin < end; ++begin) {
      const std::size_t next = rungs[begin].empty() ? 0 : rungs[begin].back() + 1;
      for (std::size_t effect = next; effect < effects; ++effect) {
        rungs.push_back(rungs[begin]);
        rungs.back().push_back(effect);
      }
    }
  }
  return rungs;
}

void read(TomlSection& own, StudyConfig& study) {
  const auto most = static_cast<std::size_t>(own.integer("effects", 1, 6).value_or(2));
  std::vector<EstimatorConfig> made;
  for (const EstimatorConfig& written : study.estimators) {
    if (!written.model || written.model->model.effects.empty()) {
      own.refuse(
          "", fmt::format("estimator '{}' has no model file with effects to climb by", written.id),
          "use method = \"model_file\" and a model with an effect or more");
      continue;
    }
    const auto rungs = rungs_of(written.model->model.effects.size(), most);
    if (rungs.size() > kMostRungs) {
      own.refuse("effects", fmt::format("estimator '{}' has {} rungs", written.id, rungs.size()),
                 "take fewer effects at once, or a model with fewer");
      continue;
    }
    for (const auto& chosen : rungs) {
      EstimatorConfig& one =
          made.emplace_back(made_from(written, rung_name(*written.model, chosen)));
      one.model = with_effects(*written.model, chosen);
      one.title = one.id;
    }
  }
  if (!made.empty()) study.estimators = std::move(made);
}

struct Rung {
  std::string name;
  double parameters = 0.0, train = 0.0, holdout = 0.0, aic = 0.0, bic = 0.0;
  std::vector<CaseRow::Parameter> values;
};

/// Residuals as n independent ones of one unknown variance: n ln(2 cost / n) and its penalty.
Rung rung_of(const CasePlan& one, const CaseRow& row) {
  Rung rung;
  rung.name = one.estimator->id.substr(one.estimator->written_id().size() + 1);
  rung.parameters = row.number("parameters");
  rung.holdout = row.number("holdout_median_percent");
  rung.values = row.parameters;
  std::vector<double> train;
  for (const CaseRow::Recording& recording : row.recordings) {
    if (recording.role == "train") train.push_back(recording.error_percent);
  }
  rung.train = middle_of(train);
  const double samples = residuals_of(one, row);
  const double fit = samples * std::log(2.0 * row.number("cost") / samples);
  rung.aic = fit + 2.0 * rung.parameters;
  rung.bic = fit + std::log(samples) * rung.parameters;
  return rung;
}

AnswerTable parameters_table(const std::map<std::string, std::vector<Rung>>& ladders) {
  AnswerTable table{"ladder-parameters",
                    "Parameters with their 95 % intervals, rung by rung",
                    {"case", "rung", "parameter", "value", "from", "to", "unit"},
                    {}};
  for (const auto& [name, rungs] : ladders) {
    for (const Rung& rung : rungs) {
      for (const CaseRow::Parameter& one : rung.values) {
        table.rows.push_back({name, rung.name, one.name, one.value, one.value - 1.96 * one.std,
                              one.value + 1.96 * one.std, one.unit});
      }
    }
  }
  return table;
}

KindAnswer answer(const StudyRows& rows) {
  std::map<std::string, std::vector<Rung>> ladders;
  rows.each([&](const CasePlan& one, const CaseRow& row) {
    if (one.replicate > 0) return;
    ladders[fmt::format("{}, {}", one.input->id, one.estimator->written_id())].push_back(
        rung_of(one, row));
  });
  KindAnswer answer;
  AnswerTable table{
      "ladder",
      "Errors are medians over recordings. AIC and BIC take residuals as independent, "
      "which sampled noise with memory is not: they then favour larger models.",
      {"case", "rung", "parameters", "training / % of peak", "held out / % of peak",
       "AIC above the best", "BIC above the best"},
      {}};
  AnswerFigure figure{"ladder",
                      "Errors up the ladder",
                      "Median error on the training and the held-out recordings.",
                      "",
                      {}};
  for (const auto& [name, rungs] : ladders) {
    double aic = std::numeric_limits<double>::infinity(), bic = aic, held = aic;
    const Rung* best = nullptr;
    const Rung* baseline = nullptr;
    for (const Rung& rung : rungs) {
      aic = std::min(aic, rung.aic);
      bic = std::min(bic, rung.bic);
      if (rung.name == kBaseline) baseline = &rung;
      if (rung.holdout < held) held = rung.holdout, best = &rung;
    }
    AnswerPanel panel;
    panel.title = name;
    panel.x_label = "torque error / % of peak";
    AnswerSeries train{"training", "points", {}, {}};
    AnswerSeries holdout{"held out", "points", {}, {}};
    for (const Rung& rung : rungs) {
      const auto y = static_cast<double>(panel.y_names.size());
      panel.y_names.push_back(rung.name);
      train.x.push_back(rung.train);
      train.y.push_back(y);
      if (!std::isnan(rung.holdout)) {
        holdout.x.push_back(rung.holdout);
        holdout.y.push_back(y);
      }
      table.rows.push_back({name, rung.name, rung.parameters, rung.train, rung.holdout,
                            rung.aic - aic, rung.bic - bic});
    }
    panel.series = {train, holdout};
    figure.panels.push_back(std::move(panel));
    if (best == nullptr || baseline == nullptr) continue;
    answer.says += fmt::format(
        "{}{}: {} predicts held-out recordings best, {:.2g} % of peak against {:.2g} % of the "
        "baseline",
        answer.says.empty() ? "" : "; ", name, best->name, best->holdout, baseline->holdout);
  }
  answer.says += answer.says.empty() ? "No rung has held-out recordings to be judged on." : ".";
  answer.figures.push_back(std::move(figure));
  answer.tables.push_back(std::move(table));
  answer.tables.push_back(parameters_table(ladders));
  return answer;
}

}  // namespace

KindRow describe_model_ladder() {
  return {.id = "model_ladder",
          .summary = "a model's effects one by one and together, from the baseline up",
          .cases = "inputs x estimators with a model x sets of its effects x replicates",
          .question = "Which effects do the recordings call for?",
          .read = read,
          .answer = answer};
}

}  // namespace flexspline::studies
