#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "diagnosis/experiment.hpp"
#include "diagnosis/explanation.hpp"
#include "diagnosis/folds.hpp"
#include "diagnosis/nested_proof.hpp"
#include "diagnosis/specification.hpp"
#include "diagnosis/spelled.hpp"
#include "diagnosis/undecided.hpp"
#include "diagnosis/velocity_lag.hpp"
#include "flexspline/studies/diagnosis.hpp"

namespace flexspline::studies {
namespace {

constexpr Eigen::Index kMostRows = 16000;

double weighted_level(const Frame& frame, const EquationNoise& noise) {
  double variance = 0.0;
  double rows = 0.0;
  for (std::size_t i = 0; i < frame.segments.size(); ++i) {
    const double count = static_cast<double>(frame.segments[i].count);
    variance += count * noise.level[i] * noise.level[i];
    rows += count;
  }
  return std::sqrt(variance / rows);
}

// More than noise is left where the model's own error is larger than the noise, and no trifle.
bool is_beyond_noise(const Frame& frame, const HoldoutProof& h, const Limits& limits) {
  const double own =
      std::sqrt(std::max(h.rmse_after * h.rmse_after - h.noise_floor * h.noise_floor, 0.0));
  return h.over_noise() > limits.beyond_noise && own > limits.beyond_size * frame.torque_range;
}

Verdict verdict_of(const Frame& frame, const Selection& s,
                   const std::optional<RippleFinding>& ripple, const Diagnosis& d,
                   const Limits& limits) {
  const bool left = s.remainder || !frame.incidents.empty() || left_unnamed(s, limits) != nullptr ||
                    is_beyond_noise(frame, d.holdout, limits) ||
                    (d.cross_validated && is_beyond_noise(frame, *d.cross_validated, limits));
  const bool named = !s.accepted.empty() || (ripple && ripple->name);
  if (named) return left ? Verdict::partly_explained : Verdict::explained;
  return left ? Verdict::unexplained : Verdict::adequate;
}

/// What a model file says of causes that are in the model, but too small to be named.
std::vector<std::string> remarks_on(const Selection& s) {
  std::vector<std::string> remarks;
  for (const Accepted& small : s.immaterial) {
    remarks.push_back(
        small.trial.cause.row->of_baseline()
            ? ""
            : fmt::format("too small to be named: {:.2g} % of torque", 100.0 * small.trial.size));
  }
  return remarks;
}

void say_one_loop(const Frame& frame, Diagnosis& d) {
  d.experiments = {another_rate(frame)};
  d.next_experiment = d.experiments.front();
  std::string says = "Cannot be decided with these data: ";
  says += d.verdict == Verdict::adequate
              ? "the baseline follows this one loop, but at one amplitude and one rate viscous "
                "damping and a memory without rate look the same."
              : "this one loop differs from the baseline, but one amplitude and one rate do not "
                "tell one cause from another.";
  make_undecided(std::move(says), d);
}

void say_noise(double followed, Diagnosis& d) {
  make_undecided(
      fmt::format("Cannot be decided with these data: the torque is mostly noise, as the model "
                  "follows {:.0f} % of its variance.",
                  100.0 * std::max(followed, 0.0)),
      d);
}

void say_implausible(std::vector<data::SanityFinding> findings, Diagnosis& d) {
  make_undecided(
      fmt::format("Cannot be decided: a channel looks mistaken. {}", findings.front().message()),
      d);
  d.mistaken.insert(d.mistaken.begin(), findings.begin(), findings.end());
}

// What these recordings cannot tell, whatever was found in them.
void judge_decidable(const Frame& frame, const Selection& selection, const Limits& limits,
                     Diagnosis& d) {
  const bool unnamed = d.verdict == Verdict::adequate || d.verdict == Verdict::unexplained;
  const double followed = share_followed(frame, selection);
  if (auto findings = implausible(frame, selection, limits); !findings.empty()) {
    say_implausible(std::move(findings), d);
  } else if (one_loop(frame)) {
    say_one_loop(frame, d);
  } else if (unnamed && followed < limits.least_told) {
    say_noise(followed, d);
  }
}

void name_in_units(Diagnosis& d) {
  const bool linear = find_unit(d.display.motion)->dimension == Dimension::length;
  for (Cause& cause : d.causes) cause.unit = linear ? "N" : "Nm";
  std::ranges::stable_sort(d.causes, std::ranges::greater{}, &Cause::size_fraction);
}

Result<void> judge_held_out(const RecordingSet& all, const std::vector<std::string>& holdout,
                            const Finding& finding, Diagnosis& d) {
  auto once = judged_once(all, holdout, finding, kMostRows);
  if (!once) return tl::unexpected(once.error());
  d.cross_validated = d.holdout;
  d.holdout = std::move(once->proof);
  d.series.insert(d.series.begin(), once->series.begin(), once->series.end());
  return {};
}

// Recordings that are too few to be searched without a part of them are no failure.
std::optional<NestedProof> proved_in_folds(const RecordingSet& all, const Finding& finding,
                                           const Limits& limits, const DiagnosisProgress& progress,
                                           Diagnosis& d) {
  if (one_loop(finding.frame)) return std::nullopt;
  auto nested = nested_proof(all, finding, limits, kMostRows, progress);
  if (!nested) {
    d.notes.push_back(
        fmt::format("nothing is proved in outer folds: {}", nested.error().message()));
    return std::nullopt;
  }
  d.cross_validated = d.holdout;
  d.holdout = nested->proof;
  return std::move(*nested);
}

// Of a whole: what is done after another part of it.
DiagnosisProgress part_of(const DiagnosisProgress& progress, double from, double to) {
  if (!progress) return {};
  return [progress, from, to](double share, std::string_view stage) {
    progress(from + share * (to - from), stage);
  };
}

Result<Diagnosis> diagnosed(const RecordingSet& all, const DiagnosisProgress& progress,
                            const DiagnosisSettings& settings) {
  const auto& holdout = settings.holdout;
  if (progress) progress(0.0, "smoothing the motions");
  auto mistaken = data::sanity_of(all);
  if (data::stops_science(mistaken)) return mistaken_diagnosis(all, std::move(mistaken));
  std::optional<RecordingSet> rest;
  if (!holdout.empty()) {
    auto kept = without(all, holdout);
    if (!kept) return tl::unexpected(kept.error());
    rest = std::move(*kept);
  }
  auto frame_of_set = make_frame(rest ? *rest : all, kMostRows);
  if (!frame_of_set) return tl::unexpected(frame_of_set.error());
  Limits limits;
  limits.threads = settings.threads;
  const bool nests = settings.nested && holdout.empty();
  // Each fold's search is taken for as long as that in all recordings.
  const auto searches = 1 + (nests ? outer_folds(*frame_of_set).size() : 0);
  const double searched = 0.9 / static_cast<double>(searches);
  const auto searching = part_of(progress, 0.0, searched / 0.9);
  if (searching) searching(0.1, "fitting the baseline");
  const auto finding = find_causes(std::move(*frame_of_set), limits, searching);
  if (!finding) return tl::unexpected(finding.error());
  const auto& [frame, selection, proof] = *finding;
  Diagnosis d;
  d.dataset = all.name;
  d.sha256 = all.sha256;
  d.display = all.display;
  d.quick = !settings.nested;
  d.mistaken = std::move(mistaken);
  d.notes = all.notes;
  d.notes.insert(d.notes.end(), frame.notes.begin(), frame.notes.end());
  for (std::string& part : spelled_parts(selection)) d.notes.push_back(std::move(part));
  if (const auto lag = velocity_lag(frame)) d.notes.push_back(in_words(*lag));
  d.baseline_model = baseline_in_words(frame);
  d.baseline_rmse_train = proof.rmse_train_before;
  d.baseline_rmse_holdout = proof.holdout.rmse_before;
  const Equation shown = equation_to_prove(frame, selection);
  d.noise_std = weighted_level(frame, selection.final.noise[index_of(shown)]) *
                (shown == Equation::motor ? frame.ratio : 1.0);
  d.holdout = proof.holdout;
  d.series = spelled_series(frame, selection, proof);
  std::optional<NestedProof> nested;
  if (nests) {
    nested = proved_in_folds(all, *finding, limits, part_of(progress, searched, 0.9), d);
  } else if (!holdout.empty()) {
    const auto judged = judge_held_out(all, holdout, *finding, d);
    if (!judged) return tl::unexpected(judged.error());
  }
  if (progress) progress(0.9, "comparing the candidates");
  const auto ripple = find_ripple(frame, selection, limits);
  d.verdict = verdict_of(frame, selection, ripple, d, limits);
  auto specification = specify(frame, selection.final.fit.model, remarks_on(selection));
  d.model = std::move(specification.model);
  d.notes.insert(d.notes.end(), specification.notes.begin(), specification.notes.end());
  d.causes = spelled_causes(frame, selection, proof);
  for (Cause& cause : d.causes) {
    if (nested) cause.stability = stability_of(*nested, cause);
  }
  d.mismatch = spelled_mismatch(frame, selection, limits);
  d.confusable = spelled_confusable(frame, selection);
  d.tried = spelled_trials(selection, limits);
  if (ripple) spell_ripple(frame, selection, *ripple, d);
  name_in_units(d);
  d.moved = spelled_moves(frame, selection);
  d.experiments = next_experiments(frame, selection);
  if (!d.experiments.empty()) d.next_experiment = d.experiments.front();
  d.says = spelled_verdict(selection, limits, d);
  judge_decidable(frame, selection, limits, d);
  return d;
}

}  // namespace

std::string_view name_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::adequate:
      return "adequate";
    case Verdict::explained:
      return "explained";
    case Verdict::partly_explained:
      return "partly_explained";
    case Verdict::unexplained:
      return "unexplained";
    case Verdict::undecided:
      break;
  }
  return "undecided";
}

Result<Diagnosis> diagnose(const RecordingSet& recordings, const DiagnosisProgress& progress,
                           const DiagnosisSettings& settings) {
  const auto start = std::chrono::steady_clock::now();
  auto result = diagnosed(recordings, progress, settings);
  if (!result) return result;
  result->seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (progress) progress(1.0, "done");
  return result;
}

}  // namespace flexspline::studies
