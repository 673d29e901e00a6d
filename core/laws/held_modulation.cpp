#include <algorithm>
#include <cmath>
#include <utility>

#include "flexspline/core/law.hpp"

namespace flexspline {
namespace {

constexpr double kLimit = 2.0;  // of |ln h|

// h = exp(clamp(p, -L, L)), p = sum_k c_k (x/s)^(2k+2), k = 0, 1, ...
class HeldModulation final : public Law {
 public:
  explicit HeldModulation(LawSpec spec) : spec_(std::move(spec)) {}

  double value(double x) const override {
    return std::exp(std::clamp(exponent(x / spec_.scale), -kLimit, kLimit));
  }

  double slope(double x) const override {
    const double u = x / spec_.scale;
    if (held(u)) return 0.0;
    double sum = 0.0;
    for (std::size_t k = spec_.coefficients.size(); k-- > 0;) {
      sum = sum * u * u + static_cast<double>(2 * k + 2) * spec_.coefficients[k];
    }
    return value(x) * sum * u / spec_.scale;
  }

  void gradient(double x, std::span<double> out) const override {
    const double u = x / spec_.scale;
    double power = held(u) ? 0.0 : value(x);
    for (double& g : out) {
      power *= u * u;
      g = power;
    }
  }

  const LawSpec& spec() const override { return spec_; }

 private:
  double exponent(double u) const {
    double sum = 0.0;
    for (std::size_t k = spec_.coefficients.size(); k-- > 0;) {
      sum = (sum + spec_.coefficients[k]) * u * u;
    }
    return sum;
  }

  bool held(double u) const { return std::abs(exponent(u)) > kLimit; }

  LawSpec spec_;
};

Result<std::unique_ptr<Law>> make(const LawSpec& spec) {
  return std::make_unique<HeldModulation>(spec);
}

}  // namespace

LawRow describe_held_modulation() {
  return {.id = "held_modulation",
          .equation =
              "h = exp(clamp(p, -L, L)), p = sum_k c_k (x/s)^(2k+2), L = 2; h = 1 without terms",
          .range = "0.135 <= h <= 7.39 everywhere, even, h(0) = 1; a corner where it is held",
          .source = "the bounds 0 < alpha <= h <= beta of Dhaouadi and Ghorbel (2003), eq. (1)",
          .make = make};
}

}  // namespace flexspline
