#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "flexspline/core/ode_system.hpp"

namespace flexspline {

/// A system from a law: a struct with states(), parameters() and a template rate<S>.
template <class Law>
class SystemOf final : public OdeSystem {
 public:
  explicit SystemOf(Law law = {}) : law_(law) {}
  std::size_t states() const override { return law_.states(); }
  std::size_t parameters() const override { return law_.parameters(); }
  void rate(double t, std::span<const double> y, std::span<const double> p,
            std::span<double> ydot) const override {
    law_.template rate<double>(t, y, p, ydot);
  }
  void rate(double t, std::span<const Dual> y, std::span<const Dual> p,
            std::span<Dual> ydot) const override {
    law_.template rate<Dual>(t, y, p, ydot);
  }

 private:
  Law law_;
};

/// y'' = -w^2 y.
struct Oscillator {
  std::size_t states() const { return 2; }
  std::size_t parameters() const { return 1; }
  template <class S>
  void rate(double, std::span<const S> y, std::span<const S> p, std::span<S> out) const {
    out[0] = y[1];
    out[1] = S(-p[0] * p[0] * y[0]);
  }
};

/// Van der Pol with stiffness and drive: y'' = mu (1 - y^2) y' - k y + a cos t.
struct VanDerPol {
  std::size_t states() const { return 2; }
  std::size_t parameters() const { return 3; }
  template <class S>
  void rate(double t, std::span<const S> y, std::span<const S> p, std::span<S> out) const {
    out[0] = y[1];
    out[1] =
        S(S(p[0] * S(S(1.0 - S(y[0] * y[0])) * y[1])) - S(p[1] * y[0]) + S(p[2] * std::cos(t)));
  }
};

/// Heat down a chain: y_i' = p_i (y_(i-1) - y_i), y_(-1) = 1 + sin t.
struct Chain {
  std::size_t links = 40;
  std::size_t states() const { return links; }
  std::size_t parameters() const { return links; }
  template <class S>
  void rate(double t, std::span<const S> y, std::span<const S> p, std::span<S> out) const {
    S before(1.0 + std::sin(t));
    for (std::size_t i = 0; i < links; ++i) {
      out[i] = S(p[i] * S(before - y[i]));
      before = y[i];
    }
  }
};

/// Table I of Dhaouadi and Ghorbel, deg and Nm, on a locked rotor whose torque is the one that
/// makes the loop phi = 0.2 sin(w t) the exact motion.
struct LockedRotor {
  static constexpr double kInertia = 1.815 * std::numbers::pi / 180.0;  // Nm/(deg/s^2)
  static constexpr double kFrequency = 2.0 * std::numbers::pi * 0.005;
  static constexpr double kAmplitude = 0.2;
  double viscous = 0.5;  // Nm/(deg/s)

  template <class S>
  static S odd(const S& x, const double (&c)[5]) {
    const S square(x * x);
    S sum(c[4]);
    for (int k = 3; k >= 0; --k) sum = S(S(sum * square) + c[k]);
    return S(sum * x);
  }
  template <class S>
  static S stiffness(const S& x) {
    return odd(x, {14.133, 3.71e3, -1.471e5, 3.778e6, -3.370e7});
  }
  template <class S>
  static S friction(const S& v) {
    return odd(v, {65.594, 5.571e7, -2.485e12, 5.615e16, -4.673e20});
  }
  static double position(double t) { return kAmplitude * std::sin(kFrequency * t); }
  static double speed(double t) { return kAmplitude * kFrequency * std::cos(kFrequency * t); }
  double torque(double t) const {
    return -kInertia * kFrequency * kFrequency * position(t) + viscous * speed(t) +
           stiffness(position(t)) + friction(speed(t));
  }

  std::size_t states() const { return 2; }
  std::size_t parameters() const { return 1; }
  template <class S>
  void rate(double t, std::span<const S> y, std::span<const S> p, std::span<S> out) const {
    out[0] = y[1];
    out[1] =
        S(S(S(S(torque(t)) - S(p[0] * y[1])) - S(stiffness(y[0]) + friction(y[1]))) / kInertia);
  }
};

/// y' = y^2 leaves every bound at t = 1 / y(0).
struct Explosion {
  std::size_t states() const { return 1; }
  std::size_t parameters() const { return 0; }
  template <class S>
  void rate(double, std::span<const S> y, std::span<const S>, std::span<S> out) const {
    out[0] = S(y[0] * y[0]);
  }
};

/// y' = -a y + (input + error): p = (a, error), input 0.
struct Lag {
  std::size_t states() const { return 1; }
  std::size_t parameters() const { return 2; }
  template <class S>
  void rate(double, std::span<const S> y, std::span<const S> p, std::span<S> out) const {
    out[0] = S(p[1] - S(p[0] * y[0]));
  }
};

inline std::vector<double> instants(double end, int count) {
  std::vector<double> t;
  for (int i = 0; i <= count; ++i) t.push_back(end * i / count);
  return t;
}

}  // namespace flexspline
