#pragma once

#include <vector>

#include "flexspline/core/signals.hpp"
#include "flexspline/core/spline.hpp"

namespace flexspline::estimators {

/// A record with what is computed once of it: the smooth signals behind it, its noise, and the
/// samples that get a residual.
struct PreparedRecord {
  TorsionRecord record;
  Reconstruction smooth;
  Spline position, velocity, acceleration, effort;
  std::vector<std::size_t>
      rows;  ///< valid samples of the steady part (or of all), thinned where very many
  double motion_sigma = 0.0;           ///< of measured motion, never below a step of its encoder
  double effort_noise = 0.0;           ///< of measured effort
  std::vector<double> effort_sigma{};  ///< a row: noise of effort and of the motion it follows
};

/// Errors: numerics, where a record cannot be reconstructed or has no valid sample to fit.
Result<std::vector<PreparedRecord>> prepare(const std::vector<TorsionRecord>& records,
                                            std::size_t most_rows);

/// Largest |motion|, about half_range_centre's centre where zeros are free, and |velocity|.
struct Ranges {
  double motion = 0.0;
  double velocity = 0.0;
  double acceleration = 0.0;
  double effort = 0.0;
  double lowest_motion = 0.0;
  double highest_motion = 0.0;
  double shortest_period = 0.0;
};
Ranges ranges_of(const std::vector<PreparedRecord>& records, bool centred);

/// The middle of a record's motion.
double centre_of(const PreparedRecord& record);

}  // namespace flexspline::estimators
