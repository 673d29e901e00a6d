#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "flexspline/core/cubic_basis.hpp"
#include "flexspline/core/law.hpp"

namespace flexspline {
namespace {

// Cubic spline on [knots[0], knots[1]] in units of the scale, linear beyond.
class FreeSpline final : public Law {
 public:
  explicit FreeSpline(LawSpec spec)
      : spec_(std::move(spec)),
        basis_(spec_.knots[0], spec_.knots[1], spec_.coefficients.size() - 3) {}

  double value(double x) const override {
    const auto [inside, beyond] = split(x);
    const auto local = basis_.at(inside);
    double sum = 0.0;
    for (std::size_t k = 0; k < 4; ++k) {
      sum += spec_.coefficients[local.first + k] * (local.value[k] + beyond * local.slope[k]);
    }
    return sum;
  }

  double slope(double x) const override {
    const auto local = basis_.at(split(x).first);
    double sum = 0.0;
    for (std::size_t k = 0; k < 4; ++k) sum += spec_.coefficients[local.first + k] * local.slope[k];
    return sum / spec_.scale;
  }

  void gradient(double x, std::span<double> out) const override {
    const auto [inside, beyond] = split(x);
    const auto local = basis_.at(inside);
    std::fill(out.begin(), out.end(), 0.0);
    for (std::size_t k = 0; k < 4; ++k) {
      out[local.first + k] = local.value[k] + beyond * local.slope[k];
    }
  }

  const LawSpec& spec() const override { return spec_; }

 private:
  std::pair<double, double> split(double x) const {
    const double u = x / spec_.scale;
    const double inside = std::clamp(u, spec_.knots[0], spec_.knots[1]);
    return {inside, u - inside};
  }

  LawSpec spec_;
  CubicBasis basis_;
};

Result<std::unique_ptr<Law>> make(const LawSpec& spec) {
  if (spec.knots.size() != 2 || !(spec.knots[0] < spec.knots[1]) || spec.coefficients.size() < 4) {
    return failure(
        ErrorCode::bad_data,
        fmt::format("free_spline has {} knots and {} coefficients", spec.knots.size(),
                    spec.coefficients.size()),
        "give both ends of its range in units of the scale and four coefficients or more");
  }
  return std::make_unique<FreeSpline>(spec);
}

}  // namespace

LawRow describe_free_spline() {
  return {.id = "free_spline",
          .equation = "y = sum_i c_i B_i(x/s), B_i uniform cubic B-splines over the range",
          .range = "neither odd nor monotone: a joint that travels; linear beyond the range",
          .source = "de Boor, A Practical Guide to Splines, 1978",
          .make = make};
}

}  // namespace flexspline
