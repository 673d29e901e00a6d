#pragma once

#include <optional>
#include <vector>

namespace flexspline::studies {

/// A fit with one parameter held: how much its cost rises above that of the free fit.
struct HeldFit {
  double value = 0.0;
  double rise = 0.0;  ///< 2 (C - C0)/s2 with s2 = 2 C0/(n - p): of -2 ln L, for independent noise
};

/// A free fit's parameter, and fits with it held on both sides.
struct ProfileInput {
  double estimate = 0.0;
  double std = 0.0;  ///< by the fit's covariance; NaN or 0: none
  std::vector<HeldFit> held;
};

/// The profile likelihood of one parameter. Its rise is scaled so that near the estimate it is the
/// parabola (value - estimate)^2/std^2 of the fit's own covariance, which knows of noise with
/// memory (the vertical adjustment of Chandler and Bate, 2007); where the model is linear it is
/// that parabola everywhere. Between held fits the root of the rise, with the sign of the distance,
/// is taken as straight.
class ProfileLikelihood {
 public:
  explicit ProfileLikelihood(const ProfileInput& input);

  /// Rise of -2 ln L at a value between the outermost held fits; NaN beyond.
  double rise(double value) const;
  /// Where the rise is 3.84, chi squared's 95 % with one degree of freedom; nothing where it stays
  /// below up to the outermost held fit.
  std::optional<double> lower() const { return crossing(-1.0); }
  std::optional<double> upper() const { return crossing(1.0); }
  /// By how much intervals are wider than independent noise would make them; NaN: not known.
  double widening() const { return widening_; }
  double first() const { return roots_.front().value; }
  double last() const { return roots_.back().value; }

 private:
  struct Root {
    double value = 0.0;
    double root = 0.0;  ///< of the rise, signed
  };
  std::optional<double> crossing(double sign) const;

  std::vector<Root> roots_;  ///< by value; the estimate among them
  double widening_;
};

/// 0.95 quantile of chi squared with one degree of freedom.
inline constexpr double kProfileRise = 3.841458820694124;

}  // namespace flexspline::studies
