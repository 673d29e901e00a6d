#include <cmath>
#include <utility>

#include "flexspline/core/law.hpp"

namespace flexspline {
namespace {

// h = exp(sum_k c_k (x/s)^(2k+2)), k = 0, 1, ...
class ExponentialModulation final : public Law {
 public:
  explicit ExponentialModulation(LawSpec spec) : spec_(std::move(spec)) {}

  double value(double x) const override {
    const double u2 = std::pow(x / spec_.scale, 2);
    double sum = 0.0;
    for (std::size_t k = spec_.coefficients.size(); k-- > 0;) {
      sum = (sum + spec_.coefficients[k]) * u2;
    }
    return std::exp(sum);
  }

  double slope(double x) const override {
    const double u = x / spec_.scale;
    double sum = 0.0;
    for (std::size_t k = spec_.coefficients.size(); k-- > 0;) {
      sum = sum * u * u + static_cast<double>(2 * k + 2) * spec_.coefficients[k];
    }
    return value(x) * sum * u / spec_.scale;
  }

  void gradient(double x, std::span<double> out) const override {
    const double u2 = std::pow(x / spec_.scale, 2);
    double power = value(x);
    for (double& g : out) {
      power *= u2;
      g = power;
    }
  }

  const LawSpec& spec() const override { return spec_; }

 private:
  LawSpec spec_;
};

Result<std::unique_ptr<Law>> make(const LawSpec& spec) {
  return std::make_unique<ExponentialModulation>(spec);
}

}  // namespace

LawRow describe_exponential_modulation() {
  return {.id = "exponential_modulation",
          .equation = "h = exp(sum_k c_k (x/s)^(2k+2)); h = 1 without terms",
          .range = "the fitted range only: even, h(0) = 1, and without bounds outside it",
          .source = "h > 0 of Dhaouadi and Ghorbel (2003), eq. (1), without its bounds",
          .make = make};
}

}  // namespace flexspline
