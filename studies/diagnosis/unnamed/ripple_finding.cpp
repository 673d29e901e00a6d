#include "diagnosis/unnamed/ripple_finding.hpp"

#include <algorithm>
#include <cmath>

namespace flexspline::studies {
namespace {

constexpr std::string_view kCoordinate = "motor_angle";

RippleName name_of(const Frame& frame, const Ripple& ripple) {
  RippleName name;
  name.order = std::round(ripple.order);
  if (std::abs(ripple.order - name.order) > resolved_order(frame)) return {};
  for (const CauseRow& row : causes()) {
    if (row.coordinate != kCoordinate) continue;
    const auto fits = [&](const CauseForm& form) {
      return form.ripples != nullptr && form.ripples(name.order);
    };
    const auto here = forms_on(row, frame);
    const auto form = std::ranges::find_if(here, [&](auto* f) { return fits(*f); });
    if (name.row == nullptr && form != here.end()) {
      name.row = &row;
      name.form = *form;
    } else if (std::ranges::any_of(row.forms, fits)) {
      name.others.emplace_back(row.id);
    }
  }
  return name;
}

std::optional<RippleName> proved_name(const Frame& frame, const Selection& s,
                                      const HoldoutProof& holdout, const Limits& limits,
                                      const Ripple& ripple) {
  RippleName name = name_of(frame, ripple);
  if (name.row == nullptr || ripple.share < limits.quarter) return std::nullopt;
  auto proof = prove_ripple(frame, s.final);
  if (!proof || proof->statistic < limits.named_gain) return std::nullopt;
  name.proof = std::move(*proof);
  name.evidence = {.ratio = name.proof.ratio,
                   .over_noise = holdout.over_noise(),
                   .before_over_noise = holdout.over_noise() / name.proof.ratio};
  if (!(probability_right(name.evidence) >= limits.probability)) return std::nullopt;
  name.evidence.alternatives = name.others.size();
  return name;
}

}  // namespace

std::optional<RippleFinding> find_ripple(const Frame& frame, const Selection& s,
                                         const HoldoutProof& holdout, const Limits& limits) {
  const auto ripple = ripple_left(frame, s.final);
  if (!ripple || ripple->statistic < limits.named_gain || ripple->share < limits.tenth) {
    return std::nullopt;
  }
  RippleFinding finding{*ripple, false, std::nullopt};
  finding.taken = std::ranges::any_of(
      s.accepted, [](const Accepted& a) { return a.trial.cause.row->coordinate == kCoordinate; });
  if (!finding.taken) finding.name = proved_name(frame, s, holdout, limits, *ripple);
  return finding;
}

}  // namespace flexspline::studies
