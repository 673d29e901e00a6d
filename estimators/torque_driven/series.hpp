#pragma once

#include <span>
#include <string>
#include <vector>

#include "flexspline/core/error.hpp"
#include "flexspline/core/recording.hpp"

namespace flexspline::estimators {

/// A recording in the units of a fit: motion and torque over their largest values in the set.
struct DrivenSeries {
  std::string id;
  std::vector<double> time;          ///< s
  std::vector<double> torque;        ///< at the samples
  std::vector<double> torque_slope;  ///< 1/s, of the cubic spline through them
  std::vector<double> motion;
  std::vector<double> weight;  ///< 1 over the peak, 0 where a sample is not valid
  double initial = 0.0;        ///< known motion at the first sample
  double step = 0.0;           ///< s between samples where all are alike, else 0
  bool all_valid = true;
  std::size_t counted = 0;  ///< samples after the first that are valid: residuals
  /// Samples between which a speed can be read: so many that the motion changes by a tenth of its
  /// peak on average, which is beyond the noise.
  std::size_t reading_span = 2;

  std::size_t intervals() const { return time.size() - 1; }
  double width(std::size_t n) const { return step > 0.0 ? step : time[n + 1] - time[n]; }
  /// Torque at a share of an interval.
  double torque_at(std::size_t n, double share) const {
    const double rest = 1.0 - share;
    const double bump =
        width(n) * share * rest * (rest * torque_slope[n] - share * torque_slope[n + 1]);
    return rest * rest * (1.0 + 2.0 * share) * torque[n] +
           share * share * (1.0 + 2.0 * rest) * torque[n + 1] + bump;
  }
};

/// phi' = h(phi) g(tau - f(phi)), eq. (3), with f and g odd polynomials and ln h an even one. The
/// coefficients p are those of f, of g and of ln h one after the other, in scaled units.
struct DrivenProblem {
  double motion_scale = 1.0;  ///< rad (m)
  double torque_scale = 1.0;  ///< Nm (N)
  int f = 3;                  ///< terms
  int g = 3;
  int h = 2;
  std::vector<DrivenSeries> series;

  std::size_t size() const { return static_cast<std::size_t>(f + g + h); }
  std::size_t residuals() const;  ///< samples that count
};

enum class InitialMotion { rest, measured };

/// Errors: bad_data for records without motion or torque, or too short for the terms.
Result<DrivenProblem> driven_problem(const std::vector<TorsionRecord>& records, int f, int g, int h,
                                     InitialMotion initial, std::size_t threads);

/// A linear spring by regression and a linear damper from the energy that the recordings lose, with
/// a little of every higher term; h = 1.
std::vector<double> driven_start(const DrivenProblem& problem);

/// g has to rise at zero: a damper.
bool driven_admissible(const DrivenProblem& problem, std::span<const double> p);

}  // namespace flexspline::estimators
