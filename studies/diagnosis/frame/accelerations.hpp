#pragma once

#include <array>
#include <vector>

#include "diagnosis/frame/frame.hpp"
#include "flexspline/core/rig_residuals.hpp"

namespace flexspline::studies {

/// By what the bandwidth of a motion is divided for those of its acceleration that may be chosen.
inline constexpr std::array kNarrower = {2.0, 4.0, 8.0, 16.0, 32.0};

/// What depends on the bandwidth of the accelerations, by row.
struct Accelerations {
  Eigen::ArrayXd motor, load;              ///< rad/s2
  Eigen::ArrayXd motor_error, load_error;  ///< their standard deviations
  Eigen::ArrayXd bandwidth;                ///< of the motor's, rad/s
  Eigen::ArrayXd held;  ///< 1, or 0 where an end of the recording is too near for the smoothing
};

/// Accelerations of `rows` rows; of a recording each time it is added.
class AccelerationsMaker {
 public:
  explicit AccelerationsMaker(Eigen::Index rows) : rows_(rows) {}

  /// Rows [first, first + count) from every stride-th sample. A bandwidth that leaves less than
  /// half of a recording to be judged is that before it.
  void add(const DriveChannels& channels, Eigen::Index first, Eigen::Index count,
           Eigen::Index stride);
  /// To a frame of these rows; nothing where no channels had narrower ones.
  void give(Frame& frame);

 private:
  Eigen::Index rows_;
  std::vector<Accelerations> list_;
};

/// The frame with its accelerations behind other bandwidths, by segment (Segment::bandwidth).
Frame with_bandwidths(Frame frame, const std::vector<std::size_t>& bandwidths);

}  // namespace flexspline::studies
