#include <algorithm>

#include <fmt/format.h>

#include "diagnosis/words/spelled.hpp"

namespace flexspline::studies {
namespace {

constexpr std::string_view kCoordinate = "motor_angle";

std::string in_words(const Frame& frame, const Ripple& ripple) {
  return fmt::format(
      "{:.0f} % of the fast changes left in constant-velocity segments follow the motor angle "
      "{:.2f} times a "
      "turn, {:.0f} times one of the output: {:.2g} Nm at most, {:.2g} % of the largest torque",
      100.0 * ripple.share, ripple.order, ripple.order * frame.ratio, ripple.amplitude,
      100.0 * ripple.amplitude / frame.torque_range);
}

Cause cause_of(const Frame& frame, const Ripple& ripple, const RippleName& name) {
  const RippleProof& proof = name.proof;
  Cause cause;
  cause.effect = name.row->id;
  cause.size_fraction = ripple.amplitude / frame.torque_range;
  cause.equation = name.form->equation;
  cause.size = ripple.amplitude;
  cause.unit = "Nm";
  cause.size_of = "the largest torque across the transmission";
  CauseParameter order{"order", name.order, kNotComputed, "1"};
  order.meaning = "of a turn of the motor";
  order.no_interval = "a whole number of the catalogue";
  CauseParameter amplitude{"amplitude", ripple.amplitude, kNotComputed, "Nm"};
  amplitude.meaning = "the largest of all recordings and directions";
  amplitude.no_interval = "each recording and direction has its own";
  cause.parameters = {std::move(order), std::move(amplitude)};
  cause.alternatives = name.others;
  constexpr int kEach = 4;  // sine and cosine, both ways
  cause.evidence.score_p_value =
      p_value(proof.statistic, kEach * static_cast<int>(proof.recordings.size()));
  cause.evidence.delta_bic = -ripple.statistic;
  cause.probability = probability_right(name.evidence);
  cause.evidence.holdout_rmse_ratio = proof.ratio;
  cause.evidence.ablation_ratio = 1.0 / proof.ratio;
  cause.evidence.over_noise = name.evidence.over_noise;
  cause.evidence.before_over_noise = name.evidence.before_over_noise;
  cause.evidence.left_over = name.evidence.left_over;
  return cause;
}

Mismatch mismatch_of(const Frame& frame, const Ripple& ripple) {
  return {.recording = frame.segments[ripple.segment].id,
          .from_s = ripple.from_s,
          .to_s = ripple.to_s,
          .coordinate = std::string(kCoordinate),
          .equation = std::string(name_of(Equation::torsion)),
          .says = in_words(frame, ripple)};
}

// Among all of the torque it is noise; the table says where it is not.
void add_to_tried(const Ripple& ripple, const RippleName& name, Diagnosis& d) {
  const CauseRow& row = *name.row;
  std::erase_if(d.tried, [&](const TriedCandidate& t) { return t.effect == row.id; });
  const int round =
      d.tried.empty() ? 0 : std::ranges::max(d.tried, {}, &TriedCandidate::round).round;
  d.tried.push_back({.effect = std::string(row.id),
                     .round = round + 1,
                     .misfit_removed = ripple.share,
                     .delta_bic = -ripple.statistic,
                     .holdout_rmse_ratio = name.proof.ratio,
                     .outcome = "accepted: by the fast changes in constant-velocity segments"});
}

}  // namespace

void spell_ripple(const Frame& frame, const Selection& s, const RippleFinding& finding,
                  Diagnosis& d) {
  const Ripple& ripple = finding.ripple;
  d.notes.push_back(in_words(frame, ripple) + "; it is not part of the model");
  if (finding.taken) return;
  std::erase_if(d.mismatch, [](const Mismatch& m) { return m.coordinate == kCoordinate; });
  // All of these are larger than what lies in the fast changes.
  const auto before = frame.incidents.size() + s.accepted.size() + s.unnamed.size();
  const auto behind = static_cast<std::ptrdiff_t>(std::min(d.mismatch.size(), before));
  d.mismatch.insert(d.mismatch.begin() + behind, mismatch_of(frame, ripple));
  if (!finding.name) return;
  d.causes.push_back(cause_of(frame, ripple, *finding.name));
  add_to_tried(ripple, *finding.name, d);
}

}  // namespace flexspline::studies
