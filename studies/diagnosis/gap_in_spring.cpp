#include "diagnosis/gap_in_spring.hpp"

#include <algorithm>

#include "diagnosis/law_fit.hpp"

namespace flexspline::studies {
namespace {

constexpr double kMiddle = 0.1;
// A strain-wave gear of size 45 starts at 0.58 of its last stiffness (soft_windup).
constexpr double kSoft = 0.25;

bool names_a_gap(const Selection& s) {
  return std::ranges::any_of(s.accepted,
                             [](const Accepted& a) { return a.trial.cause.row->id == "backlash"; });
}

}  // namespace

Frame with_plain_spring(Frame frame) {
  frame.plain_spring = true;
  return frame;
}

double softness(const Frame& frame, const Selection& s) {
  if (!frame.has(Equation::torsion) || frame.travels) return kNotComputed;
  const Eigen::VectorXd& own = s.final.fit.model.own[index_of(Equation::torsion)];
  const Eigen::Array2d torsion = frame.torsion_range * Eigen::Array2d(kMiddle, 1.0);
  const Eigen::ArrayXd f = elastic_torque(frame, own, torsion);
  return f[0] / (kMiddle * f[1]);
}

bool may_hide_a_gap(const Frame& frame, const Selection& s) {
  return !names_a_gap(s) && softness(frame, s) < kSoft;
}

bool tells_a_gap(const Selection& plain, const Proof& with_spline, const Proof& with_gap) {
  const HoldoutProof& spline = with_spline.holdout;
  return names_a_gap(plain) &&
         with_gap.holdout.rmse_after <= spline.ci95_upper * spline.rmse_before;
}

}  // namespace flexspline::studies
