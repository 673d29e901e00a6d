#include "diagnosis/gap_in_spring.hpp"

#include <algorithm>

#include "diagnosis/law_fit.hpp"

namespace flexspline::studies {
namespace {

constexpr double kMiddle = 0.1;
constexpr double kSoft = 0.25;  // softer than any spring of a gear that a catalogue states

bool is_a_gap(const Trial& trial) { return trial.cause.row->id == "backlash"; }

bool names_a_gap(const Selection& s) {
  return std::ranges::any_of(s.accepted, [](const Accepted& a) { return is_a_gap(a.trial); });
}

}  // namespace

Frame with_firm_spring(Frame frame) {
  frame.firm_spring = true;
  return frame;
}

double softness(const Frame& frame, const Selection& s) {
  if (!frame.has(Equation::torsion) || frame.travels) return kNotComputed;
  const Eigen::VectorXd& own = s.final.fit.model.own[index_of(Equation::torsion)];
  const Eigen::Array2d torsion = frame.torsion_range * Eigen::Array2d(kMiddle, 1.0);
  const Eigen::ArrayXd f = elastic_torque(frame, own, torsion);
  return f[0] / (kMiddle * f[1]);
}

bool may_hide_a_gap(const Frame& frame, const Selection& s, const Limits& limits) {
  if (names_a_gap(s)) return false;
  return softness(frame, s) < kSoft || std::ranges::any_of(s.last_field, [&](const Trial& t) {
           return t.cause.row != nullptr && t.net_gain >= limits.gain && is_taken_up(t, limits);
         });
}

bool has_a_gap(const Selection& s) {
  return names_a_gap(s) || std::ranges::any_of(s.accepted, [](const Accepted& a) {
           return std::ranges::any_of(a.rivals, is_a_gap);
         });
}

bool tells_a_gap(const Selection& firm, const Proof& with_free_f, const Proof& with_gap) {
  const HoldoutProof& free = with_free_f.holdout;
  return names_a_gap(firm) && with_gap.holdout.rmse_after <= free.ci95_upper * free.rmse_before;
}

}  // namespace flexspline::studies
