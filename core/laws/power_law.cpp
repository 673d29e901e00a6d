#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "flexspline/core/law.hpp"

namespace flexspline {
namespace {

constexpr double kLeastExponent = 0.2;
constexpr double kMostExponent = 5.0;
// Below it a law with n < 1 goes straight through zero, so that its slope there is finite.
constexpr double kStraightBelow = 1e-9;

// y = c |x/s|^n sgn x; coefficients c, n.
class PowerLaw final : public Law {
 public:
  explicit PowerLaw(LawSpec spec) : spec_(std::move(spec)) {}

  double value(double x) const override { return height() * power(x / spec_.scale); }

  double slope(double x) const override {
    const double u = std::abs(x / spec_.scale);
    if (straight(u)) return height() * std::pow(kStraightBelow, exponent() - 1.0) / spec_.scale;
    return height() * exponent() * std::pow(u, exponent() - 1.0) / spec_.scale;
  }

  void gradient(double x, std::span<double> out) const override {
    const double u = x / spec_.scale;
    out[0] = power(u);
    const double base = straight(std::abs(u)) ? kStraightBelow : std::abs(u);
    out[1] = u == 0.0 ? 0.0 : height() * out[0] * std::log(base);
  }

  const LawSpec& spec() const override { return spec_; }

 private:
  double height() const { return spec_.coefficients[0]; }
  double exponent() const { return spec_.coefficients[1]; }
  bool straight(double u) const { return exponent() < 1.0 && u < kStraightBelow; }
  double power(double u) const {
    if (straight(std::abs(u))) return u * std::pow(kStraightBelow, exponent() - 1.0);
    return std::copysign(std::pow(std::abs(u), exponent()), u);
  }

  LawSpec spec_;
};

Result<std::unique_ptr<Law>> make(const LawSpec& spec) {
  if (spec.coefficients.size() != 2) {
    return failure(ErrorCode::bad_data,
                   fmt::format("power_law has {} coefficients", spec.coefficients.size()),
                   "give two: the value at the scale and the exponent");
  }
  const double n = spec.coefficients[1];
  if (!(n >= kLeastExponent && n <= kMostExponent)) {
    return failure(ErrorCode::bad_data, fmt::format("power_law has the exponent {}", n),
                   fmt::format("an exponent is in [{}, {}]", kLeastExponent, kMostExponent));
  }
  return std::make_unique<PowerLaw>(spec);
}

}  // namespace

LawRow describe_power_law() {
  return {
      .id = "power_law",
      .equation = "y = c |x/s|^n sgn x",
      .range =
          "increasing everywhere for c > 0; n in [0.2, 5]; for n < 1 a straight line "
          "through zero below 1e-9 s",
      .source = "Dhaouadi and Ghorbel (2003), Table I: g^-1 is 4.50 (v/v0)^1.79 Nm to 1.1 % rms",
      .make = make};
}

}  // namespace flexspline
