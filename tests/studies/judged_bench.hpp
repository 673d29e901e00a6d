#pragma once

#include "diagnosis_checks.hpp"

namespace flexspline::studies {

/// A locked gear with presliding hysteresis of 6 %.
inline const RecordingSet& judged_bench() {
  static const RecordingSet set =
      drawn_case(Rig::locked, 202, {{"presliding_hysteresis", 0.06}}).recordings;
  return set;
}

inline Diagnosis judged(const RecordingSet& set, const DiagnosisSettings& settings = {}) {
  auto result = diagnose(set, {}, settings);
  EXPECT_TRUE(result.has_value()) << (result ? "" : result.error().message());
  return result ? *std::move(result) : Diagnosis{};
}

}  // namespace flexspline::studies
