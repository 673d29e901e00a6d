#include <cmath>
#include <utility>

#include "flexspline/core/law.hpp"

namespace flexspline {
namespace {

// Half the admissible range of ln h: h stays within a factor of 4.5 of h(0) = 1.
constexpr double kLimit = 1.5;

// h = exp(L tanh(p/L)), p = sum_k c_k (x/s)^k, k = 1, 2, ...
class BoundedModulation final : public Law {
 public:
  explicit BoundedModulation(LawSpec spec) : spec_(std::move(spec)) {}

  double value(double x) const override {
    return std::exp(kLimit * std::tanh(polynomial(x / spec_.scale) / kLimit));
  }

  double slope(double x) const override {
    const double u = x / spec_.scale;
    double derivative = 0.0;
    for (std::size_t k = spec_.coefficients.size(); k-- > 0;) {
      derivative = derivative * u + static_cast<double>(k + 1) * spec_.coefficients[k];
    }
    return value(x) * squeeze(u) * derivative / spec_.scale;
  }

  void gradient(double x, std::span<double> out) const override {
    const double u = x / spec_.scale;
    double power = value(x) * squeeze(u);
    for (double& g : out) {
      power *= u;
      g = power;
    }
  }

  const LawSpec& spec() const override { return spec_; }

 private:
  double polynomial(double u) const {
    double sum = 0.0;
    for (std::size_t k = spec_.coefficients.size(); k-- > 0;) {
      sum = (sum + spec_.coefficients[k]) * u;
    }
    return sum;
  }

  // d ln h / dp
  double squeeze(double u) const {
    const double t = std::tanh(polynomial(u) / kLimit);
    return 1.0 - t * t;
  }

  LawSpec spec_;
};

Result<std::unique_ptr<Law>> make(const LawSpec& spec) {
  return std::make_unique<BoundedModulation>(spec);
}

}  // namespace

LawRow describe_bounded_modulation() {
  return {
      .id = "bounded_modulation",
      .equation = "h = exp(L tanh(p(x/s)/L)), p(u) = sum_k c_k u^k, L = 1.5; h = 1 without terms",
      .range = "0.22 <= h <= 4.48 everywhere, h(0) = 1",
      .source = "the bounds 0 < alpha <= h <= beta of Dhaouadi and Ghorbel (2003), eq. (1)",
      .make = make};
}

}  // namespace flexspline
