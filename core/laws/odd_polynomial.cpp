#include <cmath>
#include <utility>

#include "flexspline/core/law.hpp"

namespace flexspline {
namespace {

// y = sum_k c_k (x/s)^(2k+1), k = 0, 1, ...
class OddPolynomial final : public Law {
 public:
  explicit OddPolynomial(LawSpec spec) : spec_(std::move(spec)) {}

  double value(double x) const override {
    const double u = x / spec_.scale;
    double sum = 0.0;
    for (std::size_t k = spec_.coefficients.size(); k-- > 0;) {
      sum = sum * u * u + spec_.coefficients[k];
    }
    return sum * u;
  }

  double slope(double x) const override {
    const double u = x / spec_.scale;
    double sum = 0.0;
    for (std::size_t k = spec_.coefficients.size(); k-- > 0;) {
      sum = sum * u * u + static_cast<double>(2 * k + 1) * spec_.coefficients[k];
    }
    return sum / spec_.scale;
  }

  void gradient(double x, std::span<double> out) const override {
    const double u = x / spec_.scale;
    double power = u;
    for (double& g : out) {
      g = power;
      power *= u * u;
    }
  }

  const LawSpec& spec() const override { return spec_; }

 private:
  LawSpec spec_;
};

Result<std::unique_ptr<Law>> make(const LawSpec& spec) {
  if (spec.coefficients.empty()) {
    return failure(ErrorCode::bad_data, "odd_polynomial has no coefficients", "give one or more");
  }
  return std::make_unique<OddPolynomial>(spec);
}

}  // namespace

LawRow describe_odd_polynomial() {
  return {
      .id = "odd_polynomial",
      .equation = "y = sum_k c_k (x/s)^(2k+1)",
      .range = "the fitted range only: it need not increase, and leaves it with its highest power",
      .source = "Dhaouadi and Ghorbel (2003), eqs. (20), (21)",
      .make = make};
}

}  // namespace flexspline
