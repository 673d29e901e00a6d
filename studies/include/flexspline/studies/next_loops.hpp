#pragma once

#include <functional>
#include <string>
#include <vector>

#include "flexspline/core/error.hpp"
#include "flexspline/core/recording.hpp"

namespace flexspline::studies {

/// What a loop, recorded beside what there is, is expected to tell.
struct LoopProspect {
  double amplitude = 0.0;     ///< rad (m) of torsion
  double frequency_hz = 0.0;  ///< of its sine
  bool tells_h = false;       ///< whether h is identifiable with it
  double h_half_width = 0.0;  ///< of the 95 % band of ln h, mean over 0.8 of the range; NaN: none
};

struct LoopPlan {
  LoopProspect recorded;                 ///< of the motions as recorded; no loop
  std::string says;                      ///< the verdict on h in the recordings themselves
  double torque_noise = 0.0;             ///< rms that is assumed, Nm (N)
  std::vector<LoopProspect> candidates;  ///< the most telling first
};

/// Sines of a quarter to all of the largest amplitude recorded, as fast as recorded, half, a
/// quarter and an eighth as fast, but for those recorded already. Everything is simulated by what
/// static regression finds in the recordings, with noise of the size of its residual: the motions
/// that are recorded, and those with one sine more. Expected, if the gear is like that fit.
/// progress: the share that is done. Errors: bad_data on rigs whose torsion is not what is driven
/// (free, servo, a joint that travels); those of the fit.
Result<LoopPlan> plan_loops(const RecordingSet& set,
                            const std::function<void(double)>& progress = {});

}  // namespace flexspline::studies
