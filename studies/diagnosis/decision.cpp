#include "diagnosis/decision.hpp"

#include <fmt/format.h>

#include "diagnosis/names/part_of_progress.hpp"
#include "diagnosis/next/experiment.hpp"
#include "diagnosis/search/explanation.hpp"

namespace flexspline::studies {
namespace {

constexpr Eigen::Index kMostRows = 16000;

// Motions, rates and torques of the recordings that may be searched.
Result<Frame> searched_frame(const RecordingSet& all, const std::vector<std::string>& holdout) {
  if (holdout.empty()) return make_frame(all, kMostRows);
  const auto rest = without(all, holdout);
  if (!rest) return tl::unexpected(rest.error());
  return make_frame(*rest, kMostRows);
}

// On recordings that were taken away before anything was looked for.
Result<void> prove_once(const RecordingSet& all, const std::vector<std::string>& holdout,
                        Decision& d) {
  auto once = judged_once(all, holdout, d.finding, kMostRows);
  if (!once) return tl::unexpected(once.error());
  d.cross_validated = d.proof;
  d.proof = std::move(once->proof);
  d.taken_away = std::move(once->series);
  return {};
}

// The whole search again in outer folds. Recordings that are too few to be searched without a part
// of them are no failure.
void prove_in_folds(const Frame& whole, const FoldSearches& searched, Decision& d) {
  const auto& [frame, selection, proof] = d.finding;
  if (searched.proving.empty() || one_loop(frame)) return;
  auto nested = nested_proof(whole, searched, equation_to_prove(frame, selection));
  if (!nested) {
    d.notes.push_back(
        fmt::format("nothing is proved in outer folds: {}", nested.error().message()));
    return;
  }
  d.cross_validated = d.proof;
  d.proof = nested->proof;
  d.nested = std::move(*nested);
}

bool is_something_left(const Decision& d, const Limits& limits) {
  const auto& [frame, selection, proof] = d.finding;
  return selection.remainder || d.resonance || !selection.unnamed.empty() ||
         !frame.incidents.empty() || left_unnamed(selection, limits) != nullptr ||
         is_beyond_noise(frame, d.proof, limits) ||
         (d.cross_validated && is_beyond_noise(frame, *d.cross_validated, limits));
}

Verdict verdict_of(const Decision& d, const Limits& limits) {
  const bool left = is_something_left(d, limits);
  const bool named = !d.finding.selection.accepted.empty() || (d.ripple && d.ripple->name);
  if (named) return left ? Verdict::partly_explained : Verdict::explained;
  return left ? Verdict::unexplained : Verdict::adequate;
}

// Of motions that come again a mode follows much that is none: what a table follows better is not
// told as one.
bool is_told_better(const std::optional<UnnamedPart>& table, const std::optional<Resonance>& mode) {
  return table && mode && table->equation == name_of(mode->equation) &&
         table->holdout_ratio < mode->proof.ratio;
}

}  // namespace

Result<Decision> decide(const RecordingSet& all, const DiagnosisSettings& settings,
                        const Limits& limits, const DiagnosisProgress& progress) {
  auto frame = searched_frame(all, settings.holdout);
  if (!frame) return tl::unexpected(frame.error());

  // Noise, baseline, discrepancy and causes; all of it again without each outer fold.
  const bool nests = settings.nested && settings.holdout.empty() && !one_loop(*frame);
  auto searches = search_all(all, *frame, nests, limits, kMostRows, part_of(progress, 0.0, 0.9));
  if (!searches.finding) return tl::unexpected(searches.finding.error());

  // Names, by rows that had no part in choosing them.
  judge_by_folds(*frame, searches.folds, *searches.finding);
  auto named = with_probable_names(std::move(*searches.finding), limits);
  if (!named) return tl::unexpected(named.error());
  Decision d;
  d.finding = std::move(*named);
  d.proof = d.finding.proof.holdout;
  d.ripple = find_ripple(d.finding.frame, d.finding.selection, d.proof, limits);
  d.resonance = find_resonance(d.finding.frame, d.finding.selection.final, d.finding.proof, limits);

  // Proof.
  prove_in_folds(*frame, searches.folds, d);
  if (!settings.holdout.empty()) {
    const auto judged = prove_once(all, settings.holdout, d);
    if (!judged) return tl::unexpected(judged.error());
  }

  // Abstention, and a model of what is left.
  if (progress) progress(0.9, "comparing the candidates");
  d.verdict = verdict_of(d, limits);
  if (d.verdict != Verdict::adequate && d.verdict != Verdict::explained) {
    d.unnamed = unnamed_part(d.finding.frame, d.finding.selection, d.finding.proof, limits);
    if (is_told_better(d.unnamed, d.resonance)) d.resonance.reset();
  }
  d.undecided = undecidable(d.finding.frame, d.finding.selection, d.verdict, limits);
  if (d.undecided) d.verdict = Verdict::undecided;
  return d;
}

}  // namespace flexspline::studies
