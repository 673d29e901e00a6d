#include "uncertainty/bands.hpp"

#include "uncertainty/covariance.hpp"

namespace flexspline::estimators {
namespace {

constexpr int kPoints = 121;
constexpr double kBeyond = 1.3;
constexpr double kNormal95 = 1.959963984540054;

Eigen::MatrixXd block(const Eigen::MatrixXd& covariance, const Group& group) {
  const auto first = static_cast<Eigen::Index>(group.first);
  const auto count = static_cast<Eigen::Index>(group.count);
  return covariance.block(first, first, count, count);
}

}  // namespace

FunctionBand law_band(std::string function, const Law& law, const Eigen::MatrixXd& covariance,
                      double from, double to) {
  FunctionBand band{.function = std::move(function)};
  band.valid_from = from;
  band.valid_to = to;
  const double middle = 0.5 * (from + to);
  const double half = 0.5 * (to - from) * kBeyond;
  std::vector<double> gradient(law.spec().coefficients.size());
  for (int k = 0; k < kPoints; ++k) {
    const double x = middle + half * (2.0 * k / (kPoints - 1) - 1.0);
    const double value = law.value(x);
    law.gradient(x, gradient);
    const double std = standard_deviation(covariance, gradient);
    band.argument.push_back(x);
    band.value.push_back(value);
    band.lower.push_back(value - kNormal95 * std);
    band.upper.push_back(value + kNormal95 * std);
  }
  return band;
}

std::vector<FunctionBand> torsion_bands(const TorsionLayout& layout, std::span<const double> p,
                                        const Eigen::MatrixXd& covariance, const Domain& domain) {
  std::vector<FunctionBand> bands;
  const auto f = make_law(layout.f(p));
  const auto g_inverse = make_law(layout.g_inverse(p));
  const auto h = make_law(layout.h(p));
  expects(f && g_inverse && h, "the laws of an estimate can be made");
  bands.push_back(
      law_band("f", **f, block(covariance, layout.f_group), domain.motion_from, domain.motion_to));
  bands.push_back(law_band("g_inverse", **g_inverse, block(covariance, layout.g_group),
                           -domain.velocity, domain.velocity));
  if (layout.h_group.present()) {
    bands.push_back(law_band("h", **h, block(covariance, layout.h_group), domain.motion_from,
                             domain.motion_to));
  }
  return bands;
}

}  // namespace flexspline::estimators
