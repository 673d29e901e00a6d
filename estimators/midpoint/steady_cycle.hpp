#pragma once

#include "flexspline/core/signals.hpp"
#include "flexspline/core/spline.hpp"

namespace flexspline::estimators {

/// One cycle of a steady loop: the motion and its speed from the Fourier series over all cycles,
/// the effort averaged over them, and the two branches between the motion's turns.
class SteadyCycle {
 public:
  /// Errors: numerics, where the motion turns more than twice a cycle.
  static Result<SteadyCycle> of(const TorsionRecord& record, const SteadyPart& steady);

  double lowest() const { return motion(trough_); }
  double highest() const { return motion(crest_); }

  /// The instant of the cycle at which the motion passes x on its way up, or down.
  double rising_at(double x) const { return crossing(trough_, crest_after_trough_, x); }
  double falling_at(double x) const { return crossing(crest_, trough_after_crest_, x); }

  double speed(double t) const { return speed_.value(wrapped(t)); }
  double effort(double t) const;
  int cycles() const { return cycles_; }

 private:
  SteadyCycle(const Reconstruction& smooth, const TorsionRecord& record, const SteadyPart& steady);
  Result<void> find_turns(const std::string& id);
  double motion(double t) const { return motion_.value(wrapped(t)); }
  double wrapped(double t) const;
  double crossing(double from, double to, double x) const;

  Spline motion_, speed_, effort_;
  double first_, last_;  // of the steady part
  double window_;        // begin of a cycle that is free of what precedes the steady part
  double period_;
  int cycles_;
  double crest_ = 0.0, trough_ = 0.0, crest_after_trough_ = 0.0, trough_after_crest_ = 0.0;
};

}  // namespace flexspline::estimators
