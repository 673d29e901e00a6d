#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "flexspline/core/law.hpp"

namespace flexspline {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kMostRounds = 200;

// y with x/s = P(y) = sum_k c_k y^(2k+1), on the branch through zero.
class InverseOddPolynomial final : public Law {
 public:
  explicit InverseOddPolynomial(LawSpec spec) : spec_(std::move(spec)), last_(last_rising()) {}

  double value(double x) const override {
    return std::copysign(root(std::abs(x / spec_.scale)), x);
  }

  double slope(double x) const override {
    const double y = std::abs(value(x));
    return y < last_ ? 1.0 / (spec_.scale * rise(y)) : 0.0;
  }

  // Where the value is held it moves with the place at which P' vanishes.
  void gradient(double x, std::span<double> out) const override {
    const double y = std::abs(value(x));
    const bool held = !(y < last_);
    const double share = std::copysign(1.0, x) / (held ? -bend(y) : -rise(y));
    double power = held ? 1.0 : y;
    for (std::size_t k = 0; k < out.size(); ++k) {
      out[k] = share * power * (held ? static_cast<double>(2 * k + 1) : 1.0);
      power *= y * y;
    }
  }

  const LawSpec& spec() const override { return spec_; }

 private:
  double height(double y) const {
    double sum = 0.0;
    for (std::size_t k = spec_.coefficients.size(); k-- > 0;) {
      sum = sum * y * y + spec_.coefficients[k];
    }
    return sum * y;
  }

  double rise(double y) const {
    double sum = 0.0;
    for (std::size_t k = spec_.coefficients.size(); k-- > 0;) {
      sum = sum * y * y + static_cast<double>(2 * k + 1) * spec_.coefficients[k];
    }
    return sum;
  }

  double bend(double y) const {
    double sum = 0.0;
    for (std::size_t k = spec_.coefficients.size(); k-- > 1;) {
      sum = sum * y * y + static_cast<double>((2 * k + 1) * 2 * k) * spec_.coefficients[k];
    }
    return sum * y;
  }

  // The largest y up to which P rises from zero on.
  double last_rising() const {
    double size = kInfinity;
    bool falls = false;
    for (std::size_t k = 1; k < spec_.coefficients.size(); ++k) {
      const double c = spec_.coefficients[k];
      falls = falls || c < 0.0;
      if (c == 0.0) continue;
      size = std::min(size, std::pow(spec_.coefficients[0] / std::abs(c), 0.5 / double(k)));
    }
    if (!falls) return kInfinity;
    double low = 0.0;
    for (int step = 1; rise(step * size / 64.0) > 0.0; ++step) {
      low = step * size / 64.0;
      if (step == 64 * 64) return kInfinity;
    }
    double high = low + size / 64.0;
    for (int round = 0; round < 60; ++round) {
      const double middle = 0.5 * (low + high);
      (rise(middle) > 0.0 ? low : high) = middle;
    }
    return low;
  }

  // Newton's iteration, kept between bounds by halving.
  double root(double wanted) const {
    double low = 0.0;
    double high = last_;
    if (high == kInfinity) {
      high = 1.0;
      while (height(high) < wanted && high < 1e300) high *= 2.0;
    } else if (height(high) <= wanted) {
      return high;
    }
    double y = std::min(high, wanted / spec_.coefficients[0]);
    for (int round = 0; round < kMostRounds; ++round) {
      const double error = height(y) - wanted;
      if (error == 0.0) return y;
      (error > 0.0 ? high : low) = y;
      double next = y - error / rise(y);
      if (!(next > low && next < high)) next = 0.5 * (low + high);
      if (std::abs(next - y) <= 1e-15 * y) return next;
      y = next;
    }
    return y;
  }

  LawSpec spec_;
  double last_;
};

Result<std::unique_ptr<Law>> make(const LawSpec& spec) {
  if (spec.coefficients.empty() || !(spec.coefficients[0] > 0.0)) {
    return failure(ErrorCode::bad_data,
                   spec.coefficients.empty()
                       ? "inverse_odd_polynomial has no coefficients"
                       : fmt::format("inverse_odd_polynomial has the first coefficient {}",
                                     spec.coefficients[0]),
                   "the first is positive, so that there is something to invert");
  }
  return std::make_unique<InverseOddPolynomial>(spec);
}

}  // namespace

LawRow describe_inverse_odd_polynomial() {
  return {
      .id = "inverse_odd_polynomial",
      .equation = "y with x/s = sum_k c_k y^(2k+1): g^-1 of an odd polynomial g",
      .range =
          "everywhere where g rises; where it stops rising, held at the y reached, with slope 0",
      .source =
          "eq. (3) of Dhaouadi and Ghorbel (2003) read from g, which torque-driven "
          "fits estimate, instead of from g^-1",
      .make = make};
}

}  // namespace flexspline
