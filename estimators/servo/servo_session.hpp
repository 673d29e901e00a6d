#pragma once

#include <algorithm>
#include <memory>

#include "flexspline/core/rig.hpp"
#include "flexspline/estimators/servo_fit.hpp"
#include "servo/servo_unknowns.hpp"

namespace flexspline::estimators {

/// Recordings of a servo one after another on one clock, so that one system serves them all.
struct ServoClock {
  RigInputs inputs;
  std::vector<double> start;  ///< of each recording
};

/// The form of the rig that is driven so.
constexpr std::string_view servo_form(ServoDuty duty) {
  return duty == ServoDuty::recorded ? "voltage_driven" : "position_loop";
}

/// Errors: input_missing, with the recording, where a channel is missing; bad_data, where a duty
/// cycle is not that of a proportional loop.
Result<ServoClock> servo_clock(const std::vector<const Recording*>& recordings, ServoDuty duty);

/// A rig of which some parameters follow unknowns, one unknown serving several of them.
class ServoSession final : public OdeSystem {
 public:
  ServoSession(std::unique_ptr<RigSystem> rig, std::vector<std::vector<RigTarget>> targets)
      : rig_(std::move(rig)), base_(rig_->parameter_vector()), targets_(std::move(targets)) {}

  std::size_t states() const override { return rig_->states(); }
  std::size_t parameters() const override { return targets_.size(); }
  void rate(double t, std::span<const double> y, std::span<const double> p,
            std::span<double> ydot) const override {
    rig_->rate(t, y, whole<double>(p), ydot);
  }
  void rate(double t, std::span<const Dual> y, std::span<const Dual> p,
            std::span<Dual> ydot) const override {
    rig_->rate(t, y, whole<Dual>(p), ydot);
  }
  /// The rig's parameter vector at unknowns.
  template <class S>
  std::vector<S> whole(std::span<const S> p) const {
    std::vector<S> values(base_.begin(), base_.end());
    for (std::size_t k = 0; k < targets_.size(); ++k) {
      for (const RigTarget& one : targets_[k]) values[one.at] = one.base + one.slope * p[k];
    }
    return values;
  }

 private:
  std::unique_ptr<RigSystem> rig_;
  std::vector<double> base_;
  std::vector<std::vector<RigTarget>> targets_;
};

}  // namespace flexspline::estimators
