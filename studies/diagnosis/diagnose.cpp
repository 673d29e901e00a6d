#include <algorithm>
#include <chrono>
#include <cmath>

#include <fmt/format.h>

#include "diagnosis/diagnosed.hpp"
#include "diagnosis/frame/sticking.hpp"
#include "diagnosis/frame/velocity_lag.hpp"
#include "diagnosis/model/specification.hpp"
#include "diagnosis/next/experiment.hpp"
#include "diagnosis/proof/series.hpp"
#include "diagnosis/words/spelled.hpp"
#include "flexspline/studies/diagnosis.hpp"

namespace flexspline::studies {
namespace {

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

double noise_of(const Frame& frame, const Selection& selection) {
  const Equation shown = equation_to_prove(frame, selection);
  return weighted_level(frame, selection.final.noise[index_of(shown)]) *
         (shown == Equation::motor ? frame.ratio : 1.0);
}

/// What a model file says of causes that are in the model without being named.
std::vector<std::string> remarks_on(const Selection& s, const Limits& limits) {
  std::vector<std::string> remarks;
  for (const Accepted& small : s.immaterial) {
    remarks.push_back(
        small.trial.cause.row->of_baseline()
            ? ""
            : fmt::format("too small to be named: {}", how_small(small.trial, limits)));
  }
  remarks.resize(remarks.size() + s.accepted.size());
  for (const Accepted& one : s.unnamed) {
    if (!one.trial.cause.row->in_catalogue()) {
      remarks.emplace_back("outside the catalogue");
      continue;
    }
    remarks.push_back(
        fmt::format("its form, not its name: that has a probability of {:.2g}", one.probability));
  }
  return remarks;
}

void name_in_units(Diagnosis& d) {
  const bool linear = find_unit(d.display.motion)->dimension == Dimension::length;
  for (Cause& cause : d.causes) cause.unit = linear ? "N" : "Nm";
  std::ranges::stable_sort(d.causes, std::ranges::greater{}, &Cause::size_fraction);
}

template <typename T>
void append(std::vector<T>& list, std::vector<T> more) {
  list.insert(list.end(), std::make_move_iterator(more.begin()),
              std::make_move_iterator(more.end()));
}

Diagnosis spelled(const RecordingSet& all, const Decision& decision, const Limits& limits) {
  const auto& [frame, selection, proof] = decision.finding;
  Diagnosis d;
  d.dataset = all.name;
  d.sha256 = all.sha256;
  d.display = all.display;
  d.notes = all.notes;
  append(d.notes, frame.notes);
  append(d.notes, spelled_parts(frame, selection));
  if (equation_to_prove(frame, selection) == Equation::motor) {
    d.notes.push_back(sticking_in_words(frame));
  }
  if (const auto lag = velocity_lag(frame)) d.notes.push_back(in_words(*lag));
  append(d.notes, decision.notes);
  auto specification = specify(frame, selection.final.fit.model, remarks_on(selection, limits));
  d.model = std::move(specification.model);
  append(d.notes, std::move(specification.notes));
  d.baseline_model = baseline_in_words(frame);
  d.baseline_rmse_train = proof.rmse_train_before;
  d.baseline_rmse_holdout = proof.holdout.rmse_before;
  d.noise_std = noise_of(frame, selection);
  d.verdict = decision.verdict;
  d.holdout = decision.proof;
  d.cross_validated = decision.cross_validated;
  d.series = decision.taken_away;
  append(d.series, proved_series(frame, selection, proof));
  d.causes = spelled_causes(frame, selection, proof);
  for (Cause& cause : d.causes) {
    if (decision.nested) cause.stability = stability_of(*decision.nested, cause);
  }
  d.mismatch = spelled_mismatch(frame, selection, limits, decision.resonance);
  d.confusable = spelled_confusable(frame, selection);
  d.tried = spelled_trials(selection, limits);
  d.unnamed = decision.unnamed;
  if (decision.ripple) spell_ripple(frame, selection, *decision.ripple, d);
  name_in_units(d);
  d.moved = spelled_moves(frame, selection);
  d.experiments = next_experiments(frame, selection);
  if (!d.experiments.empty()) d.next_experiment = d.experiments.front();
  d.says = spelled_verdict(selection, limits, decision.resonance, d);
  if (decision.undecided) make_undecided(*decision.undecided, d);
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

Result<Diagnosis> diagnosed(const RecordingSet& all, const DiagnosisProgress& progress,
                            const DiagnosisSettings& settings, Limits limits) {
  if (progress) progress(0.0, "smoothing the motions");
  auto mistaken = data::sanity_of(all);
  if (data::stops_science(mistaken)) return mistaken_diagnosis(all, std::move(mistaken));
  limits.threads = settings.threads;
  limits.interest = settings.interest;
  const auto decision = decide(all, settings, limits, progress);
  if (!decision) return tl::unexpected(decision.error());
  Diagnosis d = spelled(all, *decision, limits);
  d.mistaken.insert(d.mistaken.end(), std::make_move_iterator(mistaken.begin()),
                    std::make_move_iterator(mistaken.end()));
  d.quick = !settings.nested;
  d.interest = settings.interest;
  return d;
}

Result<Diagnosis> diagnose(const RecordingSet& recordings, const DiagnosisProgress& progress,
                           const DiagnosisSettings& settings) {
  const auto start = std::chrono::steady_clock::now();
  auto result = diagnosed(recordings, progress, settings, Limits{});
  if (!result) return result;
  result->seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (progress) progress(1.0, "done");
  return result;
}

}  // namespace flexspline::studies
