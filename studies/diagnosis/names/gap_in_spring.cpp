#include "diagnosis/names/gap_in_spring.hpp"

#include <algorithm>

#include "diagnosis/frame/baseline.hpp"
#include "diagnosis/model/law_fit.hpp"

namespace flexspline::studies {
namespace {

constexpr double kMiddle = 0.1;
constexpr int kPasses = 2;
constexpr double kSoft = 0.25;  // softer than any spring of a gear that a catalogue states

bool is_a_gap(const ActiveCause& cause) { return cause.row->id == "backlash"; }

// A gap whose name is not improbable.
bool names_a_gap(const Selection& s, const Limits& limits) {
  return std::ranges::any_of(s.accepted, [&](const Accepted& a) {
    return is_a_gap(a.trial.cause) && !(a.probability < limits.probability);
  });
}

// One that f may have a part of.
bool shares_with_f(const ActiveCause& cause) {
  return is_a_gap(cause) && cause.form->transform != nullptr;
}

// Whose elastic torque is f of the torsion.
bool has_spring(const Frame& frame) { return frame.has(Equation::torsion) && !frame.travels; }

// A column of the torsion equation that f counteracts, and that gains all the same.
bool is_half_hidden(const Trial& trial, const Limits& limits) {
  return trial.cause.row != nullptr && trial.net_gain >= limits.gain &&
         is_taken_up(trial, limits) &&
         std::ranges::count(trial.cause.form->at, Equation::torsion) > 0;
}

}  // namespace

Frame with_firm_spring(Frame frame) {
  frame.firm_spring = true;
  return frame;
}

double softness(const Frame& frame, const Selection& s) {
  if (!has_spring(frame)) return kNotComputed;
  const Eigen::VectorXd& own = s.final.fit.model.own[index_of(Equation::torsion)];
  const Eigen::Array2d torsion = frame.torsion_range * Eigen::Array2d(kMiddle, 1.0);
  const Eigen::ArrayXd f = elastic_torque(frame, own, torsion);
  return f[0] / (kMiddle * f[1]);
}

bool may_hide_a_gap(const Frame& frame, const Selection& s, const Limits& limits) {
  if (!has_spring(frame)) return false;
  const bool named = names_a_gap(s, limits);
  if (softness(frame, s) < (named ? kLeastSlope : kSoft)) return true;
  return !named && std::ranges::any_of(s.last_field, [&](const Trial& trial) {
    return is_half_hidden(trial, limits);
  });
}

bool has_shared_gap(const Frame& frame, const Selection& s) {
  return has_spring(frame) && std::ranges::any_of(s.final.fit.model.causes, shares_with_f);
}

Result<OtherSpring> with_other_spring(const Frame& frame, const Selection& s) {
  OtherSpring other{frame, s.final};
  other.frame.firm_spring = !frame.firm_spring;
  for (int pass = 0; pass < kPasses; ++pass) {
    if (auto fitted = refresh(other.frame, other.findings, kRefreshSteps); !fitted) {
      return tl::unexpected(fitted.error());
    }
  }
  return other;
}

bool has_a_gap(const Selection& s) {
  return std::ranges::any_of(s.accepted, [](const Accepted& a) {
    return is_a_gap(a.trial.cause) || std::ranges::any_of(a.rivals, is_a_gap, &Trial::cause);
  });
}

bool tells_a_gap(const Selection& firm, const Proof& with_free_f, const Proof& with_gap,
                 const Limits& limits) {
  const HoldoutProof& free = with_free_f.holdout;
  return names_a_gap(firm, limits) &&
         with_gap.holdout.rmse_after <= free.ci95_upper * free.rmse_before;
}

}  // namespace flexspline::studies
