#pragma once

#include <vector>

#include "diagnosis/search/corners.hpp"
#include "diagnosis/search/search.hpp"

namespace flexspline::studies {

/// Of a recording: nearer is the same stretch.
inline constexpr double kApart = 0.1;

/// The best stretch of a recording, and the best that is apart from it.
struct Stretch {
  double nats = 0.0;       ///< its log likelihood ratio
  Eigen::Index first = 0;  ///< row of the recording
  Eigen::Index count = 0;
  double elsewhere = 0.0;
};

/// The best stretch of every recording by one statistic.
struct Scan {
  enum class Of { steps, plain, corners };
  std::vector<Stretch> best;
  Of of = Of::plain;

  bool at_corners() const { return of == Of::corners; }
  bool unsure() const { return of != Of::plain; }
};

/// Stretches of the residual that findings leave of an equation, recording by recording.
class Scans {
 public:
  Scans(const Frame& frame, const std::vector<Corners>& corners, const Findings& findings,
        Equation equation);

  /// Size of the residual over the noise: a median's, rows that are not judged left out.
  double usual() const;

  /// By a step to the end of the recording: the means before and after it, held against how means
  /// of what is left beside the two wander (Newey and West 1987). By the power of 1 to 10 % of it:
  /// the likelihood of a variance of its own, a row worth eight nats at most. By a pulse of 0.5 to
  /// 1.5 %: its mean about a running parabola of 51 rows, over that of as many rows anywhere. Power
  /// and pulse apart from corners and at them; at corners power is over what is usual there.
  std::vector<Scan> all() const;

 private:
  template <class By>
  std::vector<Stretch> each(const By& by) const;
  Eigen::ArrayXd of_recording(const Eigen::ArrayXd& rows, std::size_t recording) const;
  Eigen::ArrayXd normal(std::size_t recording, double least) const;
  Eigen::ArrayXd corner_rows() const;

  const Frame& frame_;
  const std::vector<Corners>& corners_;
  Eigen::ArrayXd weighted_;  ///< over its deviation; 0 where the motion is not known
  double at_corners_;        ///< usual size at corners, over the noise
};

}  // namespace flexspline::studies
