#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "flexspline/core/drive_spec.hpp"
#include "flexspline/core/error.hpp"
#include "flexspline/core/estimate.hpp"
#include "flexspline/core/recording.hpp"
#include "flexspline/data/sanity.hpp"

namespace flexspline::studies {

/// What a diagnosis ends with; the words of flexspline-diagnosis/1.
enum class Verdict { adequate, explained, partly_explained, unexplained, undecided };

std::string_view name_of(Verdict verdict);

/// Where simulation and recording differ: an interval of a recording, and the variable in which the
/// difference is organised.
struct Mismatch {
  std::string recording;
  double from_s = kNotComputed;
  double to_s = kNotComputed;
  std::string coordinate;  ///< time, torsion, velocity, acceleration, motor_angle, load_angle,
                           ///< load, lag, reversal_memory, temperature, constant
  std::string equation;    ///< torsion, load, motor, drive: whose residual shows it
  double share_of_excess = kNotComputed;  ///< of the misfit beyond noise that the coordinate orders
  std::string says;
};

struct CauseParameter {
  std::string name;
  double value = kNotComputed;
  double std = kNotComputed;  ///< with all other parameters free; the larger of noise's and the
                              ///< jackknife's over recordings
  std::string unit;
  std::string meaning{};
  double ci95_lower = kNotComputed;
  double ci95_upper = kNotComputed;
  std::string no_interval{};  ///< why it has none
};

/// What speaks for a cause, all on recordings.
struct CauseEvidence {
  /// Of a chi square as large as its gain, over as many degrees of freedom as it has parameters,
  /// were there only noise; the search over causes is not counted (delta_bic counts it).
  double score_p_value = kNotComputed;
  double holdout_rmse_ratio = kNotComputed;  ///< with it over without it, on recordings held out
  double delta_bic = kNotComputed;           ///< with it minus without it; negative favours it
  double ablation_ratio = kNotComputed;      ///< final model without it over final model, held out
  double placebo_ratio = kNotComputed;       ///< the best absent effect of as many parameters
  /// Errors on recordings held out of the whole model and of the baseline over the noise, in the
  /// equations that the cause acts on.
  double over_noise = kNotComputed;
  double before_over_noise = kNotComputed;
  /// Log evidence of the best table without a name beside it over half of the chi square that rises
  /// without the cause, nats both; the largest of its equations.
  double left_over = kNotComputed;
};

/// An effect that was left out of the baseline.
struct Cause {
  std::string effect;
  /// That it is right, not one of its alternatives, calibrated on simulated cases of two generators
  /// and on effects added to recordings by others (docs/decisions/0031).
  double probability = kNotComputed;
  double size_fraction = kNotComputed;  ///< largest contribution over the largest torque
  double size = kNotComputed;           ///< the same, SI
  double size_ci95_lower = kNotComputed;
  double size_ci95_upper = kNotComputed;
  std::string unit{};     ///< of size: Nm, or N on a specimen that moves along a line
  std::string size_of{};  ///< which torque size_fraction is a fraction of
  std::string equation;
  std::vector<CauseParameter> parameters;
  std::vector<std::string> alternatives;  ///< at most two that explain the same signal as well
  CauseEvidence evidence;
  double stability = kNotComputed;  ///< share of the outer folds that name it or an alternative
};

/// Two effects that look alike on these recordings after the baseline has taken what it can.
struct Confusable {
  std::string effect;
  std::string with;
  double similarity = kNotComputed;  ///< |cosine| of the projected signatures
  std::string why;
};

/// A candidate that was tried, and why it was not accepted.
struct TriedCandidate {
  std::string effect;
  int round = 0;                         ///< 1: first name sought
  double misfit_removed = kNotComputed;  ///< share of the misfit beyond noise, at most 1
  double delta_bic = kNotComputed;
  double holdout_rmse_ratio = kNotComputed;
  std::string outcome;  ///< accepted, or the reason for the rejection in words
};

/// Errors on recordings held out. Not nested: every row is judged by fits that did not see it, but
/// the causes were chosen with it in view. Nested: the search was made without them, of recordings
/// that were taken away once, or anew in every outer fold.
struct HoldoutProof {
  double rmse_before = kNotComputed;  ///< in the effort of the recordings, SI
  double rmse_after = kNotComputed;
  double ratio = kNotComputed;
  double ci95_lower = kNotComputed;
  double ci95_upper = kNotComputed;
  double noise_floor = kNotComputed;
  bool nested = false;
  std::vector<std::string> recordings{};  ///< taken away once, where nested
  int folds = 0;                          ///< outer ones, where nested and nothing was taken away

  double over_noise() const { return rmse_after / noise_floor; }
};

struct NextExperiment {
  std::vector<std::string> separates;
  std::string excitation;
  double amplitude = kNotComputed;  ///< rad (m) of the torsion; of an output that turns, its angle
  double frequency_hz = kNotComputed;
  double separation_sigma = kNotComputed;
  std::string says;
};

/// A baseline parameter before and after the causes were modelled: what had absorbed them.
struct ParameterMove {
  std::string name;
  double before = kNotComputed;
  double after = kNotComputed;
  double std = kNotComputed;
  std::string unit;
};

/// A coordinate of a table and the knots between which the table is linear, SI.
struct TableAxis {
  std::string coordinate;
  std::string unit;
  std::vector<double> values;
};

/// What the model leaves, as a function of one or two coordinates that has no name.
struct UnnamedPart {
  std::vector<TableAxis> axes;
  std::vector<double> torque;  ///< at the knots, the last axis fastest; Nm at the equation's shaft
  std::string equation;        ///< torsion, load, motor
  double evidence = kNotComputed;       ///< log evidence over that of noise alone, nats
  double size_fraction = kNotComputed;  ///< largest value in the rows over the largest torque
  double share = kNotComputed;  ///< of the mean square beyond noise that the model leaves, held out
  double holdout_ratio = kNotComputed;  ///< rms with it over rms without it, on rows held out
  double ci95_lower = kNotComputed;
  double ci95_upper = kNotComputed;
  std::string proposed_equation{};  ///< a formula that follows the table; empty: none does
  std::string says{};
};

/// Series of one recording for the picture, decimated. SI.
struct DiagnosedSeries {
  std::string recording;
  Split split = Split::train;
  std::string equation;
  /// SI. motion: the torsion in its equation and where the output is locked, else the joint's
  /// angle.
  std::vector<double> time, motion, rate, measured;
  std::vector<double> before, after;  ///< modelled; NaN where the equation is not judged
  std::vector<double> motor_angle{};  ///< rad; empty where the output is locked
};

struct Diagnosis {
  std::string dataset;
  std::string sha256;
  std::string baseline_model;
  double baseline_rmse_train = kNotComputed;
  double baseline_rmse_holdout = kNotComputed;
  double noise_std = kNotComputed;
  Verdict verdict = Verdict::unexplained;
  std::string says;  ///< the verdict in a sentence
  std::vector<Mismatch> mismatch;
  std::vector<Cause> causes;  ///< largest size_fraction first
  std::vector<Confusable> confusable;
  std::vector<TriedCandidate> tried;
  std::vector<ParameterMove> moved;
  HoldoutProof holdout;
  std::optional<HoldoutProof>
      cross_validated;  ///< not nested, of the recordings searched, where holdout is nested
  /// Where something is left without a name, and a table lowers the error on recordings held out.
  std::optional<UnnamedPart> unnamed;
  std::optional<NextExperiment> next_experiment;  ///< the first of experiments
  std::vector<NextExperiment> experiments;        ///< one a pair of causes, the largest first
  std::vector<DiagnosedSeries> series;
  std::vector<std::string> notes;
  std::vector<data::SanityFinding> mistaken;  ///< what looks like a mistake, not like physics
  /// The whole rig: its constants, the baseline and the accepted effects; none where nothing is
  /// decided.
  std::optional<RigModel> model;
  DisplayUnits display;
  bool quick = false;              ///< no outer folds were asked for
  double interest = kNotComputed;  ///< DiagnosisSettings::interest that was asked for
  double seconds = kNotComputed;
};

/// Told of each stage as it begins, for a progress line: share done in [0, 1] and what it is.
using DiagnosisProgress = std::function<void(double, std::string_view)>;

struct DiagnosisSettings {
  unsigned threads = 0;  ///< 0: as many as the machine has
  /// Ids of recordings that are taken away before anything is looked for, and on which the final
  /// model is judged once.
  std::vector<std::string> holdout{};
  /// Where nothing is taken away: the whole search once more in every outer fold, without the rows
  /// that it is judged on. Without it the proof is cross-validated, the selection not nested.
  bool nested = true;
  double interest = 0.008;  ///< share of the largest torque below which no cause is named
};

/// Locates where the baseline of the rig and the recordings differ, names what was left out, models
/// it and proves it on recordings held out. It uses the recordings, the bench's constants and the
/// catalogue of effects; no names, and nothing of the order in which recordings or columns stand.
/// The result does not depend on the number of threads.
/// Errors: recordings that are not usable (data), an id that does not exist (usage), numerics.
Result<Diagnosis> diagnose(const RecordingSet& recordings, const DiagnosisProgress& progress = {},
                           const DiagnosisSettings& settings = {});

}  // namespace flexspline::studies
