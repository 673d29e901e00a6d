#include <algorithm>
#include <set>

#include "flexspline/studies/trial.hpp"

namespace flexspline::studies {
namespace {

constexpr std::size_t kAlternatives = 2;
constexpr std::size_t kMismatches = 3;

using Names = std::set<std::string, std::less<>>;

CaseKind kind_of(const ConcealedAnswer& answer) {
  if (answer.effects.empty()) return CaseKind::null;
  for (const data::HiddenFinding& effect : answer.effects) {
    if (effect.id.starts_with("unknown")) return CaseKind::unknown;
  }
  if (answer.effects.size() > 1) return CaseKind::pair;
  const auto contained = contained_on(answer.rig);
  const bool held = std::ranges::find(contained, answer.effects.front().id) != contained.end();
  return held ? CaseKind::contained : CaseKind::single;
}

Names truth_of(const ConcealedAnswer& answer) {
  Names names;
  for (const data::HiddenFinding& effect : answer.effects) names.insert(effect.id);
  return names;
}

/// The truth and its twins: names that are not wrong.
Names right_names(const ConcealedAnswer& answer) {
  Names right = truth_of(answer);
  right.insert(answer.twins.begin(), answer.twins.end());
  return right;
}

/// The name by which a cause is counted: its effect, or the alternative that is right.
std::string counted_name(const Cause& cause, const Names& right) {
  if (right.contains(cause.effect)) return cause.effect;
  for (std::size_t k = 0; k < std::min(kAlternatives, cause.alternatives.size()); ++k) {
    if (right.contains(cause.alternatives[k])) return cause.alternatives[k];
  }
  return cause.effect;
}

std::string first_name(const ConcealedAnswer& answer, const Diagnosis& diagnosis,
                       const std::vector<std::string>& got, const Names& right) {
  if (got.empty()) return diagnosis.verdict == Verdict::adequate ? "adequate" : "no name";
  const bool twin = right.contains(got.front()) && !truth_of(answer).contains(got.front());
  return twin ? answer.effects.front().id : got.front();
}

void score_location(const ConcealedAnswer& answer, const Diagnosis& diagnosis, CaseScore& score) {
  Names coordinates;
  for (const data::HiddenFinding& effect : answer.effects) {
    if (!effect.coordinate.empty()) coordinates.insert(effect.coordinate);
  }
  score.has_coordinate = !coordinates.empty() && score.kind != CaseKind::contained;
  for (std::size_t k = 0; k < std::min(kMismatches, diagnosis.mismatch.size()); ++k) {
    score.located = score.located || (score.has_coordinate &&
                                      coordinates.contains(diagnosis.mismatch[k].coordinate));
  }
}

void score_holdout(const ConcealedAnswer& answer, const HoldoutProof& holdout, CaseScore& score) {
  if (score.kind != CaseKind::single && score.kind != CaseKind::pair) return;
  score.after_over_noise = holdout.rmse_after / answer.noise_std;
  score.after_over_best = holdout.rmse_after / answer.best_rmse;
  score.gain_share =
      (holdout.rmse_before - holdout.rmse_after) / (holdout.rmse_before - answer.best_rmse);
}

void score_names(const ConcealedAnswer& answer, const Diagnosis& diagnosis,
                 const std::vector<std::string>& got, CaseScore& score) {
  const Names truth = truth_of(answer);
  const Names right = right_names(answer);
  const Names found(got.begin(), got.end());
  const Verdict verdict = diagnosis.verdict;
  score.null_right = score.kind == CaseKind::null && verdict == Verdict::adequate && got.empty();
  score.unknown_right = score.kind == CaseKind::unknown && got.empty() &&
                        (verdict == Verdict::unexplained || verdict == Verdict::partly_explained);
  score.contained_right =
      score.kind == CaseKind::contained &&
      std::ranges::all_of(got, [&](const auto& name) { return right.contains(name); }) &&
      (!got.empty() || verdict == Verdict::adequate);
  if (score.kind == CaseKind::single) {
    score.first_right = !got.empty() && right.contains(got.front());
    score.exact = score.first_right && got.size() == 1;
  }
  if (score.kind == CaseKind::pair) {
    const auto is_found = [&](const std::string& effect) {
      const auto twins = twins_of(effect, answer.rig);
      return found.contains(effect) || std::ranges::any_of(twins, [&](const std::string& twin) {
               return found.contains(twin);
             });
    };
    score.pair_both = std::ranges::all_of(truth, is_found);
    score.pair_one = std::ranges::any_of(truth, is_found);
  }
}

}  // namespace

std::string_view name_of(CaseKind kind) {
  switch (kind) {
    case CaseKind::null:
      return "null";
    case CaseKind::single:
      return "single";
    case CaseKind::pair:
      return "pair";
    case CaseKind::contained:
      return "contained";
    case CaseKind::unknown:
      break;
  }
  return "unknown";
}

CaseScore score_case(const ConcealedAnswer& answer, const Diagnosis* diagnosis) {
  CaseScore score;
  score.kind = kind_of(answer);
  score.failed = diagnosis == nullptr;
  if (score.failed) return score;
  const Names right = right_names(answer);
  std::vector<std::string> got;
  for (const Cause& cause : diagnosis->causes) {
    got.push_back(counted_name(cause, right));
    score.false_names += right.contains(got.back()) ? 0 : 1;
  }
  score.named = static_cast<int>(got.size());
  score.detected = diagnosis->verdict != Verdict::adequate;
  score.first_name = first_name(answer, *diagnosis, got, right);
  score_names(answer, *diagnosis, got, score);
  score_location(answer, *diagnosis, score);
  score_holdout(answer, diagnosis->holdout, score);
  return score;
}

}  // namespace flexspline::studies
