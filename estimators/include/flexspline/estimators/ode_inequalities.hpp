#pragma once

#include <span>
#include <string>
#include <vector>

#include "flexspline/core/hyper_dual.hpp"

namespace flexspline::estimators {

/// Functions of the system's parameters that a fit keeps within bounds: lower <= g(p) <= upper.
class OdeInequalities {
 public:
  virtual ~OdeInequalities() = default;

  virtual std::size_t count() const = 0;
  virtual std::string name(std::size_t i) const = 0;
  virtual double lower(std::size_t i) const = 0;  ///< may be -infinity
  virtual double upper(std::size_t i) const = 0;  ///< may be infinity, above lower
  virtual void values(std::span<const double> p, std::span<double> g) const = 0;
  /// With exact first and second derivatives.
  virtual void values(std::span<const HyperDual> p, std::span<HyperDual> g) const = 0;
  /// Where the functions stand for a limit on a whole range: what holds on all of it, in sentences.
  virtual std::vector<std::string> between(std::span<const double>) const { return {}; }
};

/// Inequalities whose functions are written once: Derived has count(), name(i), lower(i), upper(i)
/// and template <class S> void functions(std::span<const S> p, std::span<S> g) const.
template <class Derived>
class OdeInequalityLaw : public OdeInequalities {
 public:
  void values(std::span<const double> p, std::span<double> g) const final {
    static_cast<const Derived&>(*this).functions(p, g);
  }
  void values(std::span<const HyperDual> p, std::span<HyperDual> g) const final {
    static_cast<const Derived&>(*this).functions(p, g);
  }
};

}  // namespace flexspline::estimators
