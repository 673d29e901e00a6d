#pragma once

#include "diagnosis/model/model.hpp"

namespace flexspline::studies {

/// Noise of one equation's residual, Nm. In all that follows a residual's rows that are NaN do not
/// count, and are bridged by a line where a running parabola of their neighbours needs them.
struct EquationNoise {
  std::vector<double> level;   ///< standard deviation by segment, Nm
  double colour = 1.0;         ///< long-run variance over variance: 1 for white noise
  Eigen::Index alike = 1;      ///< rows over which it hardly changes
  Eigen::ArrayXd of_motion{};  ///< torque_of_motion_error(), Nm by row; empty: none
};

/// Standard deviation by recording. Where its motion repeats: of what the residual does not repeat
/// from one cycle to the next, so of noise however slow, whatever a model misses; else what is left
/// about a running parabola of 51 samples (Savitzky and Golay 1964), its freedom counted, to which
/// the slow noise of those that repeat is added. Never less than that about the parabola, to which
/// a model error that changes within a few samples is noise.
std::vector<double> noise_levels(const Frame& frame, const Eigen::ArrayXd& residual);

/// By how much a colour that is measured about a running parabola is too small, which slow noise
/// passes only in part: the limits of a decision are in chi squares of honest noise.
inline constexpr double kUnseenColour = 2.5;

/// Long-run variance over variance, at least 1: by the autocorrelations of what the residual does
/// not repeat, summed by pairs while these are positive (Geyer 1992). Where no recording's motion
/// repeats: kUnseenColour times 1 + 2 sum of forty autocorrelations of the residual about a running
/// parabola of 161 samples.
double noise_colour(const Frame& frame, const Eigen::ArrayXd& residual);

/// Rows over which the noise stays alike: the first lag at which its autocorrelation, measured as
/// for noise_colour(), is a half or less; 1 for white noise.
Eigen::Index rows_alike(const Frame& frame, const Eigen::ArrayXd& residual);

/// Weights of the rows that a fit looks at. Rows whose noise is alike tell one thing: one of each
/// `alike` rows of a recording stands for all, by the root of their number, so that sums of squares
/// keep their size. 1000 rows of a recording stay, where it has them.
Eigen::ArrayXd weights_of_fit(const Frame& frame, const Eigen::ArrayXd& weight, Eigen::Index alike);

/// Whether a level or colour of noise has changed by so little, a fiftieth of itself, that no fit
/// does.
bool is_settled(double level, double before);

/// The noise of an equation's residual, measured as it would be if motions had no error, on the
/// rows where these do no more than noise. level: that known before, by segment; empty: none is,
/// and the one that settles is taken. Of a torque that an acceleration tells (torque_by_inertia)
/// never less than what this is known to: smoothing leaves noise as slow as a law's error.
EquationNoise noise_without(const Frame& frame, Equation equation, const Eigen::ArrayXd& residual,
                            Eigen::ArrayXd of_motion, std::vector<double> level);

/// Standard deviation of an equation's residual by row, Nm: of its noise and of what errors of
/// the motions do (effective variance, Orear 1982); 0 outside the recordings.
Eigen::ArrayXd deviation_of(const Frame& frame, const EquationNoise& noise);

/// 1 for rows in which errors of the motions do no more than noise, else 0.
Eigen::ArrayXd motion_is_known(const Frame& frame, const EquationNoise& noise);

/// A residual as it would be if motions had no error: times the deviation of its noise over all of
/// it.
Eigen::ArrayXd as_noise_alone(const Frame& frame, const EquationNoise& noise,
                              const Eigen::ArrayXd& residual);

/// Weights 1/deviation of usable rows.
Eigen::ArrayXd weights_of(const Frame& frame, Equation equation, const EquationNoise& noise);

}  // namespace flexspline::studies
