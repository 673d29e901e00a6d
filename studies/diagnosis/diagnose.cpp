#include <algorithm>
#include <chrono>
#include <cmath>

#include <fmt/format.h>

#include "diagnosis/experiment.hpp"
#include "diagnosis/explanation.hpp"
#include "diagnosis/prove.hpp"
#include "diagnosis/specification.hpp"
#include "diagnosis/spelled.hpp"
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

// One loop proves no cause: there is nothing to hold it against.
Result<void> leave_out_unproved(const Frame& frame, const Limits& limits, Selection& selection) {
  while (one_loop(frame) && !selection.accepted.empty()) {
    const auto left_out = leave_out(frame, limits, selection, selection.accepted.size() - 1,
                                    "one loop cannot prove it");
    if (!left_out) return left_out;
  }
  return {};
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
  const auto frame = make_frame(recordings, kMostRows);
  if (!frame) return tl::unexpected(frame.error());
  if (progress) progress(0.1, "fitting the baseline");
  Limits limits;
  limits.threads = threads;
  auto selection = select_causes(*frame, limits, progress);
  if (!selection) return tl::unexpected(selection.error());
  if (progress) progress(0.75, "proving on recordings held out");
  const auto proved = leave_out_unproved(*frame, limits, *selection);
  if (!proved) return tl::unexpected(proved.error());
  const auto proof = confirm(*frame, limits, *selection);
  if (!proof) return tl::unexpected(proof.error());
  if (progress) progress(0.9, "comparing the candidates");
  Diagnosis d;
  d.dataset = recordings.name;
  d.sha256 = recordings.sha256;
  d.display = recordings.display;
  d.notes = recordings.notes;
  d.notes.insert(d.notes.end(), frame->notes.begin(), frame->notes.end());
  d.baseline_model = baseline_in_words(*frame);
  d.baseline_rmse_train = proof->rmse_train_before;
  d.baseline_rmse_holdout = proof->holdout.rmse_before;
  const Equation shown = equation_to_prove(*frame, *selection);
  d.noise_std = weighted_level(*frame, selection->final.noise[index_of(shown)]) *
                (shown == Equation::motor ? frame->ratio : 1.0);
  d.verdict = verdict_of(*selection, limits);
  auto specification = specify(*frame, selection->final.fit.model);
  d.model = std::move(specification.model);
  d.notes.insert(d.notes.end(), specification.notes.begin(), specification.notes.end());
  d.holdout = proof->holdout;
  d.causes = spelled_causes(*frame, *selection, *proof);
  d.mismatch = spelled_mismatch(*frame, *selection, limits);
  d.confusable = spelled_confusable(*frame, *selection);
  d.tried = spelled_trials(*selection, limits);
  spell_ripple(*frame, *selection, limits, d);
  d.moved = spelled_moves(*frame, *selection);
  d.series = spelled_series(*frame, *selection, *proof);
  d.next_experiment = next_experiment(*frame, *selection);
  d.says = spelled_verdict(*selection, limits, d);
  if (one_loop(*frame)) say_undecided(*frame, d);
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
