#pragma once

#include <map>
#include <string>
#include <vector>

#include "flexspline/reports/study_view.hpp"

namespace flexspline::reports {

/// Two estimators of a study that differ in one respect, as its lock file names them.
struct Contrast {
  std::string id, title, from, to;
};

/// Noise of an input's recordings, in percent of amplitude and of peak torque.
struct NoiseLevel {
  double angle = kAbsent;
  double torque = kAbsent;

  friend auto operator<=>(const NoiseLevel&, const NoiseLevel&) = default;
};

/// The steps of a study's ablation, and by input id the noise of what has its own.
struct AblationPlan {
  std::vector<Contrast> contrasts;
  std::map<std::string, NoiseLevel> noise;
};
AblationPlan parse_ablation(const std::string& lock);

/// Errors of the first over those of the second, on one input: above 1, the step helps. The median
/// over the replicates.
struct Gain {
  const Input* input = nullptr;
  double g_inverse = kAbsent;
  double torque = kAbsent;  ///< median over held-out recordings within the range of both
};

/// Inputs on which both estimators ran. Empty where either is not part of the study.
std::vector<Gain> gains_of(const StudyView& view, const std::string& from, const std::string& to);

/// Smallest, median and largest of the finite ones.
struct Spread3 {
  double least = kAbsent;
  double median = kAbsent;
  double most = kAbsent;
};
Spread3 spread_of(const std::vector<Gain>& gains, double Gain::*of);

}  // namespace flexspline::reports
