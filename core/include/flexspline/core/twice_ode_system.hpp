#pragma once

#include <span>

#include "flexspline/core/hyper_dual.hpp"
#include "flexspline/core/ode_system.hpp"

namespace flexspline {

/// An initial value problem whose law also gives exact second derivatives, which collocation needs.
class TwiceOdeSystem : public OdeSystem {
 public:
  using OdeSystem::rate;
  virtual void rate(double t, std::span<const HyperDual> y, std::span<const HyperDual> p,
                    std::span<HyperDual> ydot) const = 0;
};

/// A system from a law written once: Derived has states(), parameters() and
///   template <class S>
///   void law(double t, std::span<const S> y, std::span<const S> p, std::span<S> ydot) const;
/// Intermediate results are of type S, never auto: duals are expression templates.
template <class Derived>
class OdeLaw : public TwiceOdeSystem {
 public:
  void rate(double t, std::span<const double> y, std::span<const double> p,
            std::span<double> ydot) const final {
    derived().law(t, y, p, ydot);
  }
  void rate(double t, std::span<const Dual> y, std::span<const Dual> p,
            std::span<Dual> ydot) const final {
    derived().law(t, y, p, ydot);
  }
  void rate(double t, std::span<const HyperDual> y, std::span<const HyperDual> p,
            std::span<HyperDual> ydot) const final {
    derived().law(t, y, p, ydot);
  }

 private:
  const Derived& derived() const { return static_cast<const Derived&>(*this); }
};

}  // namespace flexspline
