#include "diagnosis/names/undecided.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "diagnosis/next/experiment.hpp"

namespace flexspline::studies {
namespace {

using data::SanityFinding;
using Eigen::ArrayXd;

constexpr std::string_view kDead = "dead_channel";

/// A channel that is dead in every recording leaves nothing to look at.
const SanityFinding* dead_everywhere(const RecordingSet& set,
                                     const std::vector<SanityFinding>& findings) {
  for (const SanityFinding& one : findings) {
    const auto channel = one.what.substr(0, one.what.find(' '));
    const auto recordings = std::ranges::count_if(findings, [&](const SanityFinding& other) {
      return other.check == kDead && other.what.starts_with(channel + " ");
    });
    if (one.check == kDead && recordings == std::ssize(set.recordings)) return &one;
  }
  return nullptr;
}

SanityFinding finding(const CauseRow& row, std::string what) {
  return {"check_units",
          "implausible_cause",
          data::Severity::error,
          "",
          fmt::format("the misfit looks like {}, {}", row.id, what),
          "check the units, the signs and the gear ratio of all channels"};
}

std::optional<SanityFinding> rescaled(const Accepted& accepted, const Eigen::VectorXd& a,
                                      const Limits& limits) {
  if (!accepted.trial.cause.form->rescales || std::abs(a[0]) < limits.half) return std::nullopt;
  auto found =
      finding(*accepted.trial.cause.row, fmt::format("a channel off by {:+.3g} of itself", a[0]));
  if (std::abs(a[0]) > 1.0) found.code = "check_sign";
  return found;
}

// Friction and what a joint carries may be most of a torque, and a motor that is late and kicked
// lacks the kick. A change of the motion is as large as the spring is stiff and the motion fast.
bool may_be_large(const CauseForm& form) {
  return form.friction || form.unbounded || form.trails || form.transform != nullptr;
}

// What moves has a mass: less of it than half of what is stated says that the acceleration or the
// torque is none.
std::optional<SanityFinding> takes_away(const Frame& frame, const Accepted& accepted,
                                        const Eigen::VectorXd& a, const Limits& limits) {
  const auto stated = accepted.trial.cause.form->stated;
  if (stated == nullptr || !(a[0] < -limits.half * frame.*stated)) return std::nullopt;
  if (!(frame.*stated > 0.0)) return std::nullopt;
  return finding(
      *accepted.trial.cause.row,
      fmt::format("{:.3g} kg m2 beside the {:.3g} that are stated", a[0], frame.*stated));
}

std::optional<SanityFinding> too_large(const Accepted& accepted, const Limits& limits) {
  const Trial& trial = accepted.trial;
  if (may_be_large(*trial.cause.form) || trial.size < limits.half) return std::nullopt;
  return finding(*trial.cause.row,
                 fmt::format("of {:.0f} % of the largest torque", 100.0 * trial.size));
}

// Share of the variance of the measured torque that the final model follows, in the equation to
// prove.
double share_followed(const Frame& frame, const Selection& s) {
  const Equation equation = equation_to_prove(frame, s);
  const ArrayXd& torque = equation == Equation::motor ? frame.motor_torque : frame.torque;
  const ArrayXd rows = frame.rows_of(equation);
  const double mean = (torque * rows).sum() / rows.sum();
  const double variance = ((torque - mean).square() * rows).sum();
  const double left = (s.final.fit.residual[index_of(equation)].square() * rows).sum();
  return variance > 0.0 ? 1.0 - left / variance : 0.0;
}

Undecidable of_one_loop(const Frame& frame, Verdict verdict) {
  std::string says = "Cannot be decided with these data: ";
  says += verdict == Verdict::adequate
              ? "the baseline follows this one loop, but at one amplitude and one rate viscous "
                "damping and a memory without rate look the same."
              : "this one loop differs from the baseline, but one amplitude and one rate do not "
                "tell one cause from another.";
  return {std::move(says), {}, another_rate(frame)};
}

Undecidable of_noise(double followed) {
  return {
      fmt::format("Cannot be decided with these data: the torque is mostly noise, as the model "
                  "follows {:.0f} % of its variance.",
                  100.0 * std::max(followed, 0.0))};
}

}  // namespace

Result<Diagnosis> mistaken_diagnosis(const RecordingSet& set, std::vector<SanityFinding> findings) {
  if (const SanityFinding* dead = dead_everywhere(set, findings)) {
    return failure(ErrorCode::bad_data, fmt::format("{} of every recording", dead->what),
                   dead->remedy);
  }
  Diagnosis d;
  d.dataset = set.name;
  d.sha256 = set.sha256;
  d.display = set.display;
  d.notes = set.notes;
  d.baseline_model = "none: nothing was fitted";
  std::string says = fmt::format(
      "Cannot be decided: the recordings look mistaken, so that no physics is read out of them. {}",
      findings.front().message());
  make_undecided({std::move(says), std::move(findings)}, d);
  return d;
}

std::vector<SanityFinding> implausible(const Frame& frame, const Selection& s,
                                       const Limits& limits) {
  std::vector<SanityFinding> list;
  for (std::size_t i = 0; i < s.accepted.size(); ++i) {
    const auto& a = s.final.fit.model.coefficients[s.immaterial.size() + i];
    if (auto gain = rescaled(s.accepted[i], a, limits)) {
      list.push_back(std::move(*gain));
    } else if (auto mass = takes_away(frame, s.accepted[i], a, limits)) {
      list.push_back(std::move(*mass));
    } else if (auto large = too_large(s.accepted[i], limits)) {
      list.push_back(std::move(*large));
    }
  }
  return list;
}

std::optional<Undecidable> undecidable(const Frame& frame, const Selection& s, Verdict verdict,
                                       const Limits& limits) {
  if (auto findings = implausible(frame, s, limits); !findings.empty()) {
    std::string says =
        fmt::format("Cannot be decided: a channel looks mistaken. {}", findings.front().message());
    return Undecidable{std::move(says), std::move(findings)};
  }
  if (one_loop(frame)) return of_one_loop(frame, verdict);
  const bool unnamed = verdict == Verdict::adequate || verdict == Verdict::unexplained;
  const double followed = share_followed(frame, s);
  if (unnamed && followed < limits.half) return of_noise(followed);
  return std::nullopt;
}

void make_undecided(Undecidable why, Diagnosis& d) {
  d.verdict = Verdict::undecided;
  d.causes.clear();
  d.model.reset();
  d.unnamed.reset();
  d.says = std::move(why.says);
  d.mistaken = std::move(why.mistaken);
  if (!why.experiment) return;
  d.experiments = {*why.experiment};
  d.next_experiment = std::move(why.experiment);
}

}  // namespace flexspline::studies
