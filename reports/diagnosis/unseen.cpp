#include <cmath>

#include "figures/diagnosis_figures.hpp"
#include "numbers.hpp"

namespace flexspline::reports {
namespace {

std::string sentence_of(const DiagnosisView& view) {
  if (!std::isfinite(view.after) || !view.has_additions()) {
    return "The baseline's misfit on recordings kept back is " + digits(view.before, 3) + " " +
           view.rmse_unit + ", " + digits(view.before / view.noise_floor, 3) +
           " times the noise floor of " + digits(view.noise_floor, 3) + " " + view.rmse_unit +
           ". Nothing was added that could change it.";
  }
  std::string text = "The misfit " + view.how_held_out() + " goes from " + digits(view.before, 3) +
                     " to " + digits(view.after, 3) + " " + view.rmse_unit + ": a factor of " +
                     digits(view.ratio, 2);
  if (std::isfinite(view.ratio_lower) && std::isfinite(view.ratio_upper)) {
    text += " (95 %: " + digits(view.ratio_lower, 2) + " to " + digits(view.ratio_upper, 2) + ")";
  }
  text += ". The noise floor is " + digits(view.noise_floor, 3) + " " + view.rmse_unit;
  const double left = view.after / view.noise_floor;
  if (std::isfinite(left)) text += "; what is left is " + digits(left, 3) + " times that";
  return text + ".";
}

Table holdout_table(const DiagnosisView& view) {
  Table table{"holdout",
              "Misfit on recordings held out, without and with the missing physics, and the noise "
              "below which no model can come.",
              {{"model", "", 3},
               {"rms on hold-out", view.rmse_unit, 3},
               {"over noise", "", 3},
               {"over baseline", "", 3},
               {"from", "", 3},
               {"to (95 %)", "", 3}},
              {}};
  const auto add = [&](const char* name, double rmse, double ratio, double lower, double upper) {
    if (!std::isfinite(rmse)) return;
    table.rows.push_back({name, rmse, rmse / view.noise_floor, ratio, lower, upper});
  };
  add("baseline", view.before, 1.0, kAbsent, kAbsent);
  if (view.has_additions()) {
    add("with the missing physics", view.after, view.ratio, view.ratio_lower, view.ratio_upper);
  }
  add("noise floor", view.noise_floor, view.noise_floor / view.before, kAbsent, kAbsent);
  return without_empty_columns(std::move(table));
}

/// What becomes of the hold-out when a cause is taken out again, and of a placebo.
Table controls_table(const DiagnosisView& view) {
  Table table{"controls",
              "Two controls. Taken out again: how many times larger the misfit on hold-out becomes "
              "when the final model loses the cause. Placebo: what an effect that is not there "
              "gains with as many parameters (1: nothing).",
              {{"cause", "", 3}, {"taken out again", "", 3}, {"placebo", "", 3}},
              {}};
  for (const ShownCause& cause : view.causes) {
    table.rows.push_back({words(cause.effect), cause.ablation_ratio, cause.placebo_ratio});
  }
  return without_empty_columns(std::move(table));
}

std::optional<Section> draw(const DiagnosisView& view) {
  if (!std::isfinite(view.before)) return std::nullopt;
  Section section{"unseen-section", "Does it hold on recordings held out?", {}};
  section.add(Verdict{sentence_of(view)});
  section.add(holdout_table(view));
  if (!view.causes.empty()) section.add(controls_table(view));
  if (Figure figure = before_after_figure(view); !figure.frames.empty()) {
    section.add(std::move(figure));
  }
  return section;
}

}  // namespace

DiagnosisSectionRow describe_unseen() { return {40, draw}; }

}  // namespace flexspline::reports
