#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <string_view>

#include "flexspline/studies/trial.hpp"

namespace flexspline::studies {
namespace {

constexpr std::size_t kAlternatives = 2;
constexpr std::size_t kMismatches = 3;

using Names = std::set<std::string, std::less<>>;

CaseKind kind_of(const ConcealedAnswer& answer) {
  if (answer.generator == "splice") {
    return answer.effects.empty() ? CaseKind::kept : CaseKind::spliced;
  }
  if (answer.effects.empty()) return CaseKind::null;
  for (const data::HiddenFinding& effect : answer.effects) {
    if (data::hidden_class(effect.id) == data::HiddenClass::incident) return CaseKind::incident;
    if (data::hidden_class(effect.id) == data::HiddenClass::unknown) return CaseKind::unknown;
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

/// What is right for one effect: itself, the names of its row, its structural twins.
Names class_of(const data::HiddenFinding& effect, data::BenchKind rig) {
  Names names = {effect.id};
  names.insert(effect.names.begin(), effect.names.end());
  for (std::string& twin : twins_of(effect.id, rig)) names.insert(std::move(twin));
  return names;
}

Names right_names(const ConcealedAnswer& answer) {
  Names right(answer.twins.begin(), answer.twins.end());
  for (const data::HiddenFinding& effect : answer.effects) {
    right.merge(class_of(effect, answer.rig));
  }
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
  const bool open =
      diagnosis.verdict == Verdict::adequate || diagnosis.verdict == Verdict::undecided;
  if (got.empty()) return open ? std::string(name_of(diagnosis.verdict)) : "no name";
  const bool twin = right.contains(got.front()) && !truth_of(answer).contains(got.front());
  return twin ? answer.effects.front().id : got.front();
}

bool is_left(Verdict verdict) {
  return verdict == Verdict::unexplained || verdict == Verdict::partly_explained;
}

/// Of what a cause has as a sine and a cosine, "sine_2": the amplitude, "amplitude_order_2", and
/// its interval, sine and cosine apart.
CauseParameter amplitude_of(const CauseParameter& sine, const CauseParameter& cosine,
                            const std::string& order) {
  CauseParameter amplitude = sine;
  amplitude.name = order.empty() ? "amplitude" : "amplitude_order" + order;
  amplitude.value = std::hypot(sine.value, cosine.value);
  const auto half = [&](const CauseParameter& p) {
    return 0.5 * (p.ci95_upper - p.ci95_lower) * p.value / amplitude.value;
  };
  const double spread = std::hypot(half(sine), half(cosine));
  amplitude.ci95_lower = amplitude.value - spread;
  amplitude.ci95_upper = amplitude.value + spread;
  return amplitude;
}

/// The parameters that have an interval, and amplitudes.
std::vector<CauseParameter> with_intervals(const Cause& cause) {
  constexpr std::string_view kSine = "sine";
  std::vector<CauseParameter> list;
  std::ranges::copy_if(cause.parameters, std::back_inserter(list),
                       [](const CauseParameter& p) { return std::isfinite(p.std); });
  const std::size_t own = list.size();
  for (std::size_t k = 0; k < own; ++k) {
    if (!list[k].name.starts_with(kSine)) continue;
    const std::string order = list[k].name.substr(kSine.size());
    const auto cosine = std::ranges::find(list, "cosine" + order, &CauseParameter::name);
    if (cosine != list.end()) list.push_back(amplitude_of(list[k], *cosine, order));
  }
  return list;
}

/// Intervals of the parameters that a right cause and the truth have in common, by name and unit.
void score_intervals(const ConcealedAnswer& answer, const Cause& cause, CaseScore& score) {
  for (const data::HiddenFinding& effect : answer.effects) {
    if (effect.id != cause.effect) continue;
    for (const CauseParameter& found : with_intervals(cause)) {
      const std::string key = key_of({found.name, found.value, found.unit});
      const auto truth = std::ranges::find(effect.parameters, key,
                                           [](const auto& parameter) { return key_of(parameter); });
      if (truth == effect.parameters.end()) continue;
      score.intervals.push_back({effect.id + " " + key, found.ci95_lower, found.ci95_upper,
                                 std::copysign(truth->value, found.value)});
    }
  }
}

void score_location(const ConcealedAnswer& answer, const Diagnosis& diagnosis, CaseScore& score) {
  Names coordinates;
  for (const data::HiddenFinding& effect : answer.effects) {
    if (!effect.coordinate.empty()) coordinates.insert(effect.coordinate);
  }
  score.has_coordinate =
      !coordinates.empty() && score.kind != CaseKind::contained && score.kind != CaseKind::incident;
  for (std::size_t k = 0; k < std::min(kMismatches, diagnosis.mismatch.size()); ++k) {
    score.located = score.located || (score.has_coordinate &&
                                      coordinates.contains(diagnosis.mismatch[k].coordinate));
  }
}

void score_holdout(const ConcealedAnswer& answer, const HoldoutProof& holdout, CaseScore& score) {
  const double best = answer.best_rmse * answer.at_output;
  score.over_noise = holdout.rmse_after / (answer.noise_std * answer.at_output);
  if (score.kind != CaseKind::single && score.kind != CaseKind::pair) return;
  score.after_over_noise = score.over_noise;
  score.after_over_best = holdout.rmse_after / best;
  score.gain_share = (holdout.rmse_before - holdout.rmse_after) / (holdout.rmse_before - best);
}

NameScore score_names(const ConcealedAnswer& answer, CaseKind kind, Verdict verdict,
                      const std::vector<std::string>& got) {
  const Names right = right_names(answer);
  const Names found(got.begin(), got.end());
  const auto is_right = [&](const std::string& name) { return right.contains(name); };
  NameScore score;
  if (kind == CaseKind::kept || kind == CaseKind::spliced) return score;
  score.false_names = static_cast<int>(got.size() - std::ranges::count_if(got, is_right));
  if (kind == CaseKind::contained) {
    score.contained_right =
        std::ranges::all_of(got, is_right) && (!got.empty() || verdict == Verdict::adequate);
  }
  if (kind == CaseKind::single) {
    score.first_right = !got.empty() && is_right(got.front());
    score.exact = score.first_right && got.size() == 1;
  }
  if (kind == CaseKind::pair) {
    const auto is_found = [&](const data::HiddenFinding& effect) {
      return std::ranges::any_of(class_of(effect, answer.rig),
                                 [&](const std::string& name) { return found.contains(name); });
    };
    score.pair_both = std::ranges::all_of(answer.effects, is_found);
    score.pair_one = std::ranges::any_of(answer.effects, is_found);
  }
  return score;
}

/// A place no shorter than the windows in which one is sought, about its middle.
data::HiddenPlace widened(data::HiddenPlace place) {
  constexpr double kWindow = 0.05;  // of a recording
  const double lacks = kWindow * place.duration_s - (place.to_s - place.from_s);
  if (lacks <= 0.0) return place;
  place.from_s = std::max(0.0, place.from_s - 0.5 * lacks);
  place.to_s = std::min(place.duration_s, place.to_s + 0.5 * lacks);
  return place;
}

/// Intersection over union of two intervals of one recording.
double overlap_of(const data::HiddenPlace& place, const Mismatch& mismatch) {
  if (mismatch.recording != place.recording) return 0.0;
  const double both = std::min(place.to_s, mismatch.to_s) - std::max(place.from_s, mismatch.from_s);
  const double either =
      std::max(place.to_s, mismatch.to_s) - std::min(place.from_s, mismatch.from_s);
  return both > 0.0 ? both / either : 0.0;
}

void score_place(const ConcealedAnswer& answer, const Diagnosis& diagnosis, CaseScore& score) {
  constexpr double kFound = 0.3;
  for (const data::HiddenFinding& effect : answer.effects) {
    if (!effect.place) continue;
    score.overlap = 0.0;
    for (std::size_t k = 0; k < std::min(kMismatches, diagnosis.mismatch.size()); ++k) {
      score.overlap =
          std::max(score.overlap, overlap_of(widened(*effect.place), diagnosis.mismatch[k]));
    }
    score.incident_found = diagnosis.verdict != Verdict::adequate && score.overlap >= kFound;
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
    case CaseKind::incident:
      return "incident";
    case CaseKind::kept:
      return "kept";
    case CaseKind::spliced:
      return "spliced";
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
  std::vector<std::string> counted;
  for (const Cause& cause : diagnosis->causes) {
    got.push_back(cause.effect);
    counted.push_back(counted_name(cause, right));
    score.names.push_back({cause.effect, right.contains(cause.effect), cause.probability});
    score_intervals(answer, cause, score);
  }
  static_cast<NameScore&>(score) = score_names(answer, score.kind, diagnosis->verdict, got);
  score.with_alternatives = score_names(answer, score.kind, diagnosis->verdict, counted);
  score.named = static_cast<int>(got.size());
  const bool adequate = diagnosis->verdict == Verdict::adequate;
  score.detected = !adequate && diagnosis->verdict != Verdict::undecided;
  score.null_right = score.kind == CaseKind::null && adequate && got.empty();
  score.unknown_right = (score.kind == CaseKind::unknown || score.kind == CaseKind::incident) &&
                        got.empty() && is_left(diagnosis->verdict);
  if (answer.generator == "splice") score.names.clear();  // nobody knows which are right
  score.first_name = first_name(answer, *diagnosis, got, right);
  score_location(answer, *diagnosis, score);
  score_place(answer, *diagnosis, score);
  score_holdout(answer, diagnosis->holdout, score);
  return score;
}

}  // namespace flexspline::studies
