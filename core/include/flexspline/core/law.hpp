#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "flexspline/core/error.hpp"
#include "flexspline/core/model_spec.hpp"

namespace flexspline {

/// A scalar function of one variable with parameters: f, g^-1 or h of the torsion law.
class Law {
 public:
  virtual ~Law() = default;

  virtual double value(double x) const = 0;
  /// d value / dx.
  virtual double slope(double x) const = 0;
  /// d value / d coefficient, one entry a coefficient.
  virtual void gradient(double x, std::span<double> out) const = 0;
  virtual const LawSpec& spec() const = 0;
};

/// A row of the catalogue of laws.
struct LawRow {
  std::string_view id;
  std::string_view equation;
  std::string_view range;  ///< where it holds, and what it does beyond
  std::string_view source;
  Result<std::unique_ptr<Law>> (*make)(const LawSpec&);
};

/// Every law, one file each in core/laws.
std::span<const LawRow> laws();

/// Errors: a law that does not exist, or a number of coefficients or knots that does not fit it.
Result<std::unique_ptr<Law>> make_law(const LawSpec& spec);

}  // namespace flexspline
