#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "flexspline/reports/artefacts.hpp"
#include "flexspline/reports/section.hpp"

namespace flexspline::reports {

struct ShownMismatch {
  std::string recording, coordinate, equation, says;
  double from_s = kAbsent;
  double to_s = kAbsent;
  double share_of_excess = kAbsent;
};

struct ShownCauseParameter : Parameter {
  std::string meaning, no_interval;
};

struct ShownCause {
  std::string effect, equation;
  double probability = kAbsent;
  double size_fraction = kAbsent;
  double size = kAbsent;
  double size_lower = kAbsent;  ///< of its 95 % interval
  double size_upper = kAbsent;
  std::string unit, size_of;
  std::vector<ShownCauseParameter> parameters;
  std::vector<std::string> alternatives;
  double p_value = kAbsent;
  double holdout_ratio = kAbsent;
  double delta_bic = kAbsent;
  double ablation_ratio = kAbsent;
  double placebo_ratio = kAbsent;
  double stability = kAbsent;  ///< share of the outer folds that name it
};

struct ShownConfusable {
  std::string effect, with, why;
  double similarity = kAbsent;
};

struct ShownCandidate {
  std::string effect, outcome;
  int round = 0;
  double misfit_removed = kAbsent;
  double delta_bic = kAbsent;
  double holdout_ratio = kAbsent;
};

struct ShownMove {
  std::string name, unit;
  double before = kAbsent;
  double after = kAbsent;
  double std = kAbsent;
};

struct ShownTableAxis {
  std::string coordinate, unit;
  std::vector<double> values;
};

/// What the model leaves as a table over one or two coordinates, without a name.
struct ShownUnnamed {
  std::vector<ShownTableAxis> axes;
  std::vector<double> torque;  ///< at the knots, the last axis fastest
  std::string torque_unit, formula, says;
};

/// A recording along one equation: measured, and modelled without and with what was left out.
struct ShownSeries {
  std::string recording, equation;
  bool trained = false;
  std::vector<double> time, motion, rate, measured;
  std::vector<double> before, after;  ///< kAbsent where the model is not judged
  std::vector<double> motor_angle;    ///< deg; empty where the artefact has none

  /// Whether there is a model with the missing physics that differs from the one without.
  bool has_after() const;
  bool judged_everywhere() const;
};

struct ShownExperiment {
  std::vector<std::string> separates;
  std::string excitation, says;
  double amplitude = kAbsent;  ///< in units.motion
  double frequency_hz = kAbsent;
  double separation_sigma = kAbsent;
};

/// flexspline-diagnosis/1. Errors (rmse, noise) are in rmse_unit, series in units.
struct DiagnosisView {
  std::string dataset, sha256, baseline, verdict, says;
  ShownUnits units;
  std::string rmse_unit = "Nm";
  double rmse_train = kAbsent;
  double rmse_holdout = kAbsent;
  double noise = kAbsent;
  double before = kAbsent;  ///< on hold-out
  double after = kAbsent;
  double ratio = kAbsent;
  double ratio_lower = kAbsent;
  double ratio_upper = kAbsent;
  double noise_floor = kAbsent;
  bool nested = false;  ///< held out before the search
  int folds = 0;        ///< outer ones, each searched anew; 0: none

  std::vector<ShownMismatch> mismatch;
  std::vector<ShownCause> causes;
  std::vector<ShownConfusable> confusable;
  std::vector<ShownCandidate> tried;
  std::vector<ShownMove> moved;
  std::optional<ShownUnnamed> unnamed;
  std::optional<ShownExperiment> next;
  std::vector<ShownSeries> series;
  std::vector<ShownFinding> findings;
  std::vector<std::string> notes;               ///< all others
  std::map<std::string, std::string> versions;  ///< of program and libraries
  bool has_model = false;                       ///< that simulate and fit take

  bool adequate() const { return verdict == "adequate"; }
  /// Whether the final model has anything beside the baseline, named or not.
  bool has_additions() const;
  /// "on recordings taken away before the search": of which the misfit before and after is.
  std::string how_held_out() const;
  /// Whether more than one equation of the drive was looked at.
  bool has_equations() const;
};

/// Reads DIR/diagnosis.json. Errors: input_missing; bad_data, naming the file, when it is not a
/// diagnosis or its checksum does not hold.
Result<DiagnosisView> read_diagnosis(const std::filesystem::path& folder);

using DiagnosisSectionRow = SectionOf<DiagnosisView>;

/// Every section of a diagnosis, one file each in reports/diagnosis.
std::span<const DiagnosisSectionRow> diagnosis_sections();

}  // namespace flexspline::reports
