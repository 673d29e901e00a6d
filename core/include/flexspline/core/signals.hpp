#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "flexspline/core/effect.hpp"
#include "flexspline/core/error.hpp"
#include "flexspline/core/recording.hpp"

namespace flexspline {

/// A sine in noise: y = mean + amplitude cos(2 pi frequency t + phase).
struct SineFit {
  double mean = 0.0;
  double amplitude = 0.0;
  double frequency_hz = 0.0;
  double phase = 0.0;
  double explained = 0.0;  ///< share of the variance about the mean, 1 for a pure sine
};

/// Least-squares fit of amplitude, phase, mean and frequency (four-parameter fit of IEEE 1057).
/// frequency_guess: from the description of the recording; absent, the largest peak of the
/// periodogram between half a cycle and an eighth of the sampling rate is taken.
SineFit fit_sine(std::span<const double> time, std::span<const double> signal,
                 std::optional<double> frequency_guess);

/// The part of a record in which motion and effort repeat from cycle to cycle.
struct SteadyPart {
  double period = 0.0;    ///< s
  std::size_t first = 0;  ///< index of the first sample
  std::size_t last = 0;   ///< one past the last
  int cycles = 0;
};

/// Absent where the record holds fewer than two cycles or they do not repeat.
std::optional<SteadyPart> find_steady_part(const TorsionRecord& record);

/// What a noisy record says of the smooth signals behind it. On the steady part a Fourier series
/// whose order is chosen by an information criterion, elsewhere a penalised spline.
struct Reconstruction {
  Motion motion;  ///< position, velocity, acceleration at the record's instants
  std::vector<double> effort;
  std::optional<SteadyPart> steady;
  double motion_noise = 0.0;  ///< standard deviation, degrees of freedom of the smoothing counted
  double effort_noise = 0.0;
  std::vector<double> motion_error;  ///< standard error of the reconstructed position
};

/// Errors: numerics when fewer than 16 samples or a constant motion leave nothing to reconstruct.
Result<Reconstruction> reconstruct(const TorsionRecord& record);

/// Figures of one steady loop of effort over motion.
struct LoopFigures {
  double peak_effort = 0.0;
  double half_height = 0.0;  ///< half the effort gap between the branches at the mean motion
  double area = 0.0;         ///< per cycle, effort times motion, SI
};

/// Absent where the record has no steady part.
std::optional<LoopFigures> loop_figures(const TorsionRecord& record);

}  // namespace flexspline
