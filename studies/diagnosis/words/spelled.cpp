#include "diagnosis/words/spelled.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <boost/math/special_functions/gamma.hpp>

#include "diagnosis/frame/baseline.hpp"
#include "diagnosis/frame/folds.hpp"
#include "diagnosis/names/confirm.hpp"
#include "diagnosis/names/gap_in_spring.hpp"
#include "diagnosis/proof/cause_spread.hpp"
#include "diagnosis/search/explanation.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

/// Which torque a size is a fraction of, and how large that is.
struct SizeOf {
  double fraction = 0.0;
  double size = 0.0;
  std::string_view of;
};

// The largest contribution of a cause of the final model over the largest torque of the first
// equation that it acts on.
SizeOf size_of(const Frame& frame, const DriveModel& model, const Reference& reference,
               std::size_t index) {
  const Equation equation = first_equation(frame, *model.causes[index].form);
  const ArrayXd part = contribution(frame, model, reference, index, equation) * frame.usable;
  const double size = part.abs().maxCoeff();
  return {size / frame.largest_torque(equation), size,
          equation == Equation::motor ? "the largest motor torque"
                                      : "the largest torque across the transmission"};
}

// Weighted change of the prediction by a trial, equation under equation.
Eigen::VectorXd change_of(const Frame& frame, const Findings& findings, const Trial& trial) {
  Eigen::VectorXd change =
      Eigen::VectorXd::Zero(frame.rows() * static_cast<Index>(frame.equations.size()));
  Index at = 0;
  for (Equation equation : frame.equations) {
    const std::size_t e = index_of(equation);
    if (trial.fit.residual[e].size() > 0 && findings.fit.residual[e].size() > 0) {
      change.segment(at, frame.rows()) =
          ((findings.fit.residual[e] - trial.fit.residual[e]) * findings.weight[e]).matrix();
    }
    at += frame.rows();
  }
  return change;
}

std::string outcome_of(const Accepted& a) {
  if (a.withdrawn_because.empty()) return "accepted";
  return fmt::format("withdrawn: {}", a.withdrawn_because);
}

std::string outcome_of(const Trial& t, bool rival, const Limits& limits) {
  if (rival) return "explains the same signal nearly as well: an alternative";
  if (t.net_gain < limits.gain) return "gains no more than noise would";
  if (is_taken_up(t, limits)) return "absorbed by the baseline";
  return "gains less than the accepted one";
}

TriedCandidate tried(const Trial& t, int round, std::string outcome) {
  return {.effect = std::string(t.cause.row->id),
          .round = round,
          .misfit_removed = t.removed,
          .delta_bic = -t.net_gain,
          .holdout_rmse_ratio = kNotComputed,
          .outcome = std::move(outcome)};
}

void add_round(const Accepted& a, int round, const Limits& limits,
               std::vector<TriedCandidate>& list) {
  list.push_back(tried(a.trial, round, outcome_of(a)));
  for (const Trial& t : a.rivals) list.push_back(tried(t, round, outcome_of(t, true, limits)));
  for (const Trial& t : a.field) {
    if (t.cause.row != nullptr) list.push_back(tried(t, round, outcome_of(t, false, limits)));
  }
}

std::string why_immaterial(const Trial& trial, const Limits& limits) {
  return fmt::format("there, but {} is too small to be named", how_small(trial, limits));
}

// So that the intervals hold those of others, or where these have none their values.
void widen(const std::vector<CauseParameter>& others, std::vector<CauseParameter>& parameters) {
  for (CauseParameter& p : parameters) {
    const auto other = std::ranges::find(others, p.name, &CauseParameter::name);
    if (other == others.end()) continue;
    const bool told = std::isfinite(other->ci95_lower);
    p.ci95_lower = std::min(p.ci95_lower, told ? other->ci95_lower : other->value);
    p.ci95_upper = std::max(p.ci95_upper, told ? other->ci95_upper : other->value);
  }
}

void leave_untold(std::vector<CauseParameter>& parameters) {
  for (CauseParameter& p : parameters) {
    p.ci95_lower = p.ci95_upper = kNotComputed;
    p.no_interval = "the model beside the other spring, free or firm, cannot be fitted";
  }
}

/// Parameters of causes with their intervals: where f may have a part of a gap, beside either
/// spring.
class BothSprings {
 public:
  BothSprings(const Frame& frame, const Selection& s) : spread_(frame, s.final) {
    if (!has_shared_gap(frame, s)) return;
    other_ = with_other_spring(frame, s);
    if (*other_) beside_.emplace((*other_)->frame, (*other_)->findings);
  }

  const CauseSpread& spread() const { return spread_; }

  std::vector<CauseParameter> parameters(std::size_t cause) const {
    auto list = spread_.parameters(cause);
    if (beside_) {
      widen(beside_->parameters(cause), list);
    } else if (other_) {
      leave_untold(list);
    }
    return list;
  }

 private:
  CauseSpread spread_;
  std::optional<Result<OtherSpring>> other_;
  std::optional<CauseSpread> beside_;
};

}  // namespace

std::string how_small(const Trial& trial, const Limits& limits) {
  if (trial.size < limits.interest) return fmt::format("{:.2g} % of torque", 100.0 * trial.size);
  return fmt::format("a gain of {:.3g} in chi square", trial.net_gain);
}

double p_value(double chi_square, int parameters) {
  constexpr double kLargest = 1200.0;
  constexpr double kSmallest = 1e-12;  // nobody knows a noise's tails further out
  return std::max(boost::math::gamma_q(0.5 * parameters, 0.5 * std::min(chi_square, kLargest)),
                  kSmallest);
}

std::string baseline_in_words(const Frame& frame) {
  std::string words = "f, g, h full trajectory, f and g odd and rising";
  if (frame.firm_spring) words += ", f nowhere much softer than in the mean";
  if (frame.travels) words = "f(angle) free, Coulomb and viscous friction";
  if (frame.has(Equation::load)) words += "; load inertia and drag";
  if (frame.torque_by_inertia) {
    words += "; the torque across the gear, which no sensor measures, by load inertia and drag";
  }
  if (frame.has(Equation::motor)) words += "; motor inertia, viscous and Coulomb friction";
  return words;
}

std::vector<std::string> spelled_parts(const Frame& frame, const Selection& s) {
  std::vector<std::string> list;
  const DriveModel& model = s.final.fit.model;
  for (std::size_t i = 0; i < model.causes.size(); ++i) {
    const auto& part = model.causes[i].row->part;
    if (!part) continue;
    list.push_back(part->says(frame, model, i) + ": part of the baseline, not an effect");
  }
  return list;
}

std::vector<Cause> spelled_causes(const Frame& frame, const Selection& s, const Proof& proof) {
  std::vector<Cause> list;
  const BothSprings springs(frame, s);
  for (std::size_t i = 0; i < s.accepted.size(); ++i) {
    const Accepted& a = s.accepted[i];
    const std::size_t at = s.immaterial.size() + i;
    Cause cause;
    cause.effect = a.trial.cause.row->id;
    const SizeOf size = size_of(frame, s.final.fit.model, s.final.reference, at);
    const Spread sizes = springs.spread().size(at, [&](const DriveModel& model) {
      return size_of(frame, model, s.final.reference, at).size;
    });
    cause.size_fraction = size.fraction;
    cause.size = size.size;
    cause.size_ci95_lower = size.size - std::min(sizes.half, size.size);
    cause.size_ci95_upper = size.size + sizes.half;
    cause.unit = "Nm";
    cause.size_of = size.of;
    cause.equation = a.trial.cause.form->equation;
    cause.parameters = springs.parameters(at);
    cause.alternatives = alternatives_of(a, s);
    cause.evidence.score_p_value = p_value(a.trial.gain, a.trial.parameters);
    cause.evidence.delta_bic = -a.trial.net_gain;
    const CauseProof& proved = proof.causes[i];
    cause.probability = probability_right(proved.name);
    cause.evidence.holdout_rmse_ratio = proved.name.ratio;
    cause.evidence.ablation_ratio = 1.0 / proved.name.ratio;
    cause.evidence.placebo_ratio = proved.placebo_ratio;
    cause.evidence.over_noise = proved.name.over_noise;
    cause.evidence.before_over_noise = proved.name.before_over_noise;
    cause.evidence.left_over = proved.name.left_over;
    list.push_back(std::move(cause));
  }
  return list;
}

std::vector<Confusable> spelled_confusable(const Frame& frame, const Selection& s) {
  std::vector<Confusable> list;
  for (std::size_t i = 0; i < s.accepted.size() && i < 1; ++i) {
    const Accepted& a = s.accepted[i];
    const Eigen::VectorXd own = change_of(frame, s.baseline, a.trial);
    for (const auto* field : {&a.rivals, &a.field}) {
      for (const Trial& t : *field) {
        if (t.cause.row == nullptr || !t.cause.row->in_catalogue()) continue;
        const Eigen::VectorXd other = change_of(frame, s.baseline, t);
        const double scale = own.norm() * other.norm();
        if (!(scale > 0.0)) continue;
        const double cosine = std::abs(own.dot(other)) / scale;
        if (cosine < 0.2) continue;
        list.push_back({std::string(t.cause.row->id), std::string(a.trial.cause.row->id), cosine,
                        fmt::format("on these recordings it removes {:.0f} % of what {} removes",
                                    100.0 * t.gain / a.trial.gain, a.trial.cause.row->id)});
      }
    }
  }
  std::ranges::stable_sort(list, std::ranges::greater{}, &Confusable::similarity);
  return list;
}

std::vector<TriedCandidate> spelled_trials(const Selection& s, const Limits& limits) {
  std::vector<TriedCandidate> list;
  int round = 0;
  for (const Accepted& a : s.immaterial) {
    if (a.trial.cause.row->of_baseline()) continue;
    list.push_back(tried(a.trial, ++round, why_immaterial(a.trial, limits)));
  }
  for (const Accepted& a : s.accepted) add_round(a, ++round, limits, list);
  for (const Accepted& a : s.unnamed) {
    const std::string_view outside = a.trial.cause.row->outside;
    list.push_back(tried(
        a.trial, ++round,
        !outside.empty() ? fmt::format("in the model, outside the catalogue: {}", outside)
        : a.material
            ? fmt::format("in the model without its name, of probability {:.2g}", a.probability)
            : why_immaterial(a.trial, limits)));
  }
  for (const Accepted& a : s.withdrawn) add_round(a, ++round, limits, list);
  ++round;
  for (const Trial& t : s.last_field) {
    if (t.cause.row == nullptr || t.cause.row->of_baseline()) continue;
    list.push_back(tried(t, round, outcome_of(t, false, limits)));
  }
  return list;
}

std::vector<ParameterMove> spelled_moves(const Frame& frame, const Selection& s) {
  std::vector<ParameterMove> list;
  if (s.accepted.empty()) return list;
  const auto add = [&](std::string name, double before, double after, std::string unit) {
    list.push_back({std::move(name), before, after, kNotComputed, std::move(unit)});
  };
  const DriveModel& before = s.baseline.fit.model;
  const DriveModel& after = s.final.fit.model;
  if (frame.has(Equation::torsion)) {
    const Reference b = reference_of(frame, before);
    const Reference a = reference_of(frame, after);
    add("largest elastic torque", b.elastic.abs().maxCoeff(), a.elastic.abs().maxCoeff(), "Nm");
    add("largest dissipative torque", b.dissipative.abs().maxCoeff(),
        a.dissipative.abs().maxCoeff(), "Nm");
  }
  if (frame.has(Equation::load)) {
    const std::size_t e = index_of(Equation::load);
    add("load drag B2", before.own[e][0], after.own[e][0], "Nm s/rad");
  }
  if (frame.has(Equation::motor)) {
    const std::size_t e = index_of(Equation::motor);
    add("motor drag B1", before.own[e][0], after.own[e][0], "Nm s/rad");
    add("motor Coulomb friction", before.own[e].tail(before.own[e].size() - 1).sum(),
        after.own[e].tail(after.own[e].size() - 1).sum(), "Nm");
  }
  return list;
}

}  // namespace flexspline::studies
