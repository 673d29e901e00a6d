#include <algorithm>
#include <chrono>
#include <cmath>

#include <fmt/format.h>

#include "diagnosis/experiment.hpp"
#include "diagnosis/explanation.hpp"
#include "diagnosis/finding.hpp"
#include "diagnosis/specification.hpp"
#include "diagnosis/spelled.hpp"
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

Verdict verdict_of(const Selection& s, const Limits& limits) {
  if (s.accepted.empty()) {
    const bool something = s.remainder || left_unnamed(s, limits) != nullptr;
    return something ? Verdict::unexplained : Verdict::adequate;
  }
  return s.remainder ? Verdict::partly_explained : Verdict::explained;
}

/// What a model file says of causes that are in the model, but too small to be named.
std::vector<std::string> remarks_on(const Selection& s) {
  std::vector<std::string> remarks;
  for (const Accepted& small : s.immaterial) {
    remarks.push_back(
        fmt::format("too small to be named: {:.2g} % of torque", 100.0 * small.trial.size));
  }
  return remarks;
}

void say_undecided(const Frame& frame, Diagnosis& d) {
  d.next_experiment = another_rate(frame);
  d.says = "Cannot be decided with these data: ";
  d.says += d.verdict == Verdict::adequate
                ? "the baseline follows this one loop, but at one amplitude and one rate viscous "
                  "damping and a memory without rate look the same."
                : "this one loop differs from the baseline, but one amplitude and one rate do not "
                  "tell one cause from another.";
  d.notes.push_back(d.says);
}

Result<Diagnosis> diagnosed(const RecordingSet& recordings, const DiagnosisProgress& progress,
                            unsigned threads) {
  if (progress) progress(0.0, "smoothing the motions");
  auto frame_of_set = make_frame(recordings, kMostRows);
  if (!frame_of_set) return tl::unexpected(frame_of_set.error());
  if (progress) progress(0.1, "fitting the baseline");
  Limits limits;
  limits.threads = threads;
  const auto finding = find_causes(std::move(*frame_of_set), limits, progress);
  if (!finding) return tl::unexpected(finding.error());
  const auto& [frame, selection, proof] = *finding;
  if (progress) progress(0.9, "comparing the candidates");
  Diagnosis d;
  d.dataset = recordings.name;
  d.sha256 = recordings.sha256;
  d.display = recordings.display;
  d.notes = recordings.notes;
  d.notes.insert(d.notes.end(), frame.notes.begin(), frame.notes.end());
  if (const auto lag = velocity_lag(frame)) d.notes.push_back(in_words(*lag));
  d.baseline_model = baseline_in_words(frame);
  d.baseline_rmse_train = proof.rmse_train_before;
  d.baseline_rmse_holdout = proof.holdout.rmse_before;
  const Equation shown = equation_to_prove(frame, selection);
  d.noise_std = weighted_level(frame, selection.final.noise[index_of(shown)]) *
                (shown == Equation::motor ? frame.ratio : 1.0);
  d.verdict = verdict_of(selection, limits);
  auto specification = specify(frame, selection.final.fit.model, remarks_on(selection));
  d.model = std::move(specification.model);
  d.notes.insert(d.notes.end(), specification.notes.begin(), specification.notes.end());
  d.holdout = proof.holdout;
  d.causes = spelled_causes(frame, selection, proof);
  d.mismatch = spelled_mismatch(frame, selection, limits);
  d.confusable = spelled_confusable(frame, selection);
  d.tried = spelled_trials(selection, limits);
  spell_ripple(frame, selection, limits, d);
  d.moved = spelled_moves(frame, selection);
  d.series = spelled_series(frame, selection, proof);
  d.next_experiment = next_experiment(frame, selection);
  d.says = spelled_verdict(selection, limits, d);
  if (one_loop(frame)) say_undecided(frame, d);
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
      break;
  }
  return "unexplained";
}

Result<Diagnosis> diagnose(const RecordingSet& recordings, const DiagnosisProgress& progress,
                           unsigned threads) {
  const auto start = std::chrono::steady_clock::now();
  auto result = diagnosed(recordings, progress, threads);
  if (!result) return result;
  result->seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (progress) progress(1.0, "done");
  return result;
}

}  // namespace flexspline::studies
