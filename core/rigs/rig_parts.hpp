#pragma once

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "flexspline/core/rig.hpp"
#include "rigs/drive_at.hpp"

namespace flexspline {

inline double rate_of(const Signal& signal, double t) {
  if (signal.rate) return signal.rate(t);
  constexpr double kStep = 1e-5;
  return (signal.value(t + kStep) - signal.value(t - kStep)) / (2.0 * kStep);
}

/// The second time derivative.
inline double bend_of(const Signal& signal, double t) {
  constexpr double kStep = 1e-4;
  return (rate_of(signal, t + kStep) - rate_of(signal, t - kStep)) / (2.0 * kStep);
}

inline const Signal& input(const RigInputs& inputs, Quantity quantity) {
  return inputs.channels.at(quantity);
}

/// Sets what a locked, free or servo rig's motor is commanded: its recorded torque.
/// loop_state: int (r - theta_m) dt where a position loop drives it.
template <class S>
S commanded_torque(const DriveSpec& drive, const RigInputs& inputs, bool loop, double t,
                   const Instant<S>& x, const S& loop_state) {
  if (!loop) return S(input(inputs, Quantity::motor_torque).value(t));
  const PositionLoop& gains = drive.position_loop;
  const Signal& reference = input(inputs, Quantity::commanded_angle);
  const S error = reference.value(t) - x.motor_angle;
  const S error_rate = rate_of(reference, t) - x.motor_speed;
  const S wanted =
      gains.proportional * error + gains.integral * loop_state + gains.derivative * error_rate;
  return limited(wanted, S(gains.limit));
}

/// Enters the torque that drives the motor, true behind recorded, and its rate.
template <class S>
void drive_motor(const DriveAt<S>& at, const DriveSpec& drive, const RigInputs& inputs, bool loop,
                 Instant<S>& x, double t, const S& loop_state) {
  if (!loop) x.motor_torque_rate = S(rate_of(input(inputs, Quantity::motor_torque), t));
  at.set_motor_torque(x, commanded_torque(drive, inputs, loop, t, x, loop_state));
}

/// The rate of what the loop commands, once the motor's acceleration is known.
template <class S>
S loop_rate(const DriveSpec& drive, const RigInputs& inputs, double t, const Instant<S>& x,
            const S& loop_state) {
  const PositionLoop& gains = drive.position_loop;
  const double most = std::abs(real_part(commanded_torque(drive, inputs, true, t, x, loop_state)));
  if (most >= gains.limit) return S(0.0);
  const Signal& reference = input(inputs, Quantity::commanded_angle);
  const S error = reference.value(t) - x.motor_angle;
  const S error_rate = rate_of(reference, t) - x.motor_speed;
  const double bend = gains.derivative == 0.0 ? 0.0 : bend_of(reference, t);
  return gains.proportional * error_rate + gains.integral * error +
         gains.derivative * (bend - x.motor_acceleration);
}

/// The real parts of another scalar's numbers.
template <class R = Complex, class S>
std::vector<R> real_parts(std::span<const S> values) {
  std::vector<R> list;
  list.reserve(values.size());
  for (const S& v : values) list.emplace_back(real_part(v));
  return list;
}

/// A rig's system from its law: a struct with model, inputs, variables and
///   template <class S> Instant<S> rates(double t, span<const S> y, span<const S> p, span<S>)
///   const.
template <class RigLaw>
class RigSystemOf final : public RigSystem {
 public:
  explicit RigSystemOf(RigLaw law) : law_(std::move(law)) {}

  std::size_t states() const override { return law_.variables.size() + law_.model.memory(); }
  std::size_t parameters() const override { return law_.model.parameters(); }
  const DriveSpec& drive() const override { return law_.model.drive(); }
  std::span<const RigVariable> variables() const override { return law_.variables; }
  std::vector<DriveParameter> parameter_list() const override {
    return parameters_of(drive(), law_.model.constants());
  }
  void rate(double t, std::span<const double> y, std::span<const double> p,
            std::span<double> ydot) const override {
    law_.template rates<double>(t, y, p, ydot);
  }
  void rate(double t, std::span<const Dual> y, std::span<const Dual> p,
            std::span<Dual> ydot) const override {
    law_.template rates<Dual>(t, y, p, ydot);
  }
  Instant<double> instant(double t, std::span<const double> y,
                          std::span<const double> p) const override {
    std::vector<double> ydot(states());
    return law_.template rates<double>(t, y, p, ydot);
  }
  Instant<Dual> instant(double t, std::span<const Dual> y, std::span<const Dual> p) const override {
    std::vector<Dual> ydot(states());
    return law_.template rates<Dual>(t, y, p, ydot);
  }

 private:
  RigLaw law_;
};

/// The form's inputs are there and the constants that must be positive are.
Result<const RigForm*> checked_form(const RigRow& row, const DriveSpec& drive,
                                    const RigInputs& inputs, std::string_view form,
                                    const std::vector<std::string_view>& positive);

}  // namespace flexspline
