#pragma once

#include <string>
#include <vector>

#include "flexspline/studies/trial.hpp"

namespace flexspline::studies {

/// An answer on a rig, put together by hand: each effect of 5 % in its catalogue's coordinate.
inline ConcealedAnswer answer_with(data::BenchKind rig, const std::vector<std::string>& ids) {
  ConcealedAnswer answer;
  answer.rig = rig;
  for (const std::string& id : ids) {
    data::HiddenFinding effect;
    effect.id = id;
    const data::HiddenRow& row = **data::find_hidden_effect(id);
    effect.coordinate = row.coordinate;
    effect.names.assign(row.names.begin(), row.names.end());
    effect.size_fraction = 0.05;
    answer.effects.push_back(effect);
    for (const std::string& twin : twins_of(id, rig)) answer.twins.push_back(twin);
  }
  answer.noise_std = 0.1;
  answer.best_rmse = 0.08;
  answer.peak_torque = 30.0;
  return answer;
}

inline Cause cause(const std::string& effect, std::vector<std::string> alternatives = {}) {
  Cause one;
  one.effect = effect;
  one.alternatives = std::move(alternatives);
  return one;
}

/// A diagnosis that says so much: hold-out 0.4 before, 0.12 after.
inline Diagnosis diagnosis_with(Verdict verdict, std::vector<Cause> causes,
                                const std::vector<std::string>& coordinates = {}) {
  Diagnosis diagnosis;
  diagnosis.verdict = verdict;
  diagnosis.causes = std::move(causes);
  for (const std::string& coordinate : coordinates) {
    diagnosis.mismatch.emplace_back().coordinate = coordinate;
  }
  diagnosis.holdout.rmse_before = 0.4;
  diagnosis.holdout.rmse_after = 0.12;
  return diagnosis;
}

/// What a diagnosis without fault would say of recordings whose answer is known.
inline Diagnosis right_diagnosis(const ConcealedAnswer& answer) {
  std::vector<Cause> causes;
  std::vector<std::string> coordinates;
  bool unknown = false;
  for (const data::HiddenFinding& effect : answer.effects) {
    const data::HiddenClass kind = data::hidden_class(effect.id);
    const bool named = kind == data::HiddenClass::named || kind == data::HiddenClass::variant;
    unknown = unknown || !named;
    if (named) causes.push_back(cause(effect.names.empty() ? effect.id : effect.names.front()));
    coordinates.push_back(effect.coordinate);
  }
  const Verdict verdict = unknown          ? Verdict::unexplained
                          : causes.empty() ? Verdict::adequate
                                           : Verdict::explained;
  Diagnosis diagnosis = diagnosis_with(verdict, causes, coordinates);
  for (std::size_t k = 0; k < answer.effects.size(); ++k) {
    const auto& place = answer.effects[k].place;
    if (!place) continue;
    diagnosis.mismatch[k].recording = place->recording;
    diagnosis.mismatch[k].from_s = place->from_s;
    diagnosis.mismatch[k].to_s = place->to_s;
  }
  diagnosis.holdout.rmse_after = answer.best_rmse;
  return diagnosis;
}

}  // namespace flexspline::studies
