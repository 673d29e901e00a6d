#include "uncertainty/bands.hpp"

#include <algorithm>
#include <functional>

#include "uncertainty/covariance.hpp"

namespace flexspline::estimators {
namespace {

constexpr int kPoints = 121;
constexpr double kBeyond = 1.3;
constexpr double kNormal95 = 1.959963984540054;

struct Ends {
  double lower;
  double upper;
};

// Ends of the interval about a value from its gradient by the coefficients.
using Spread = std::function<Ends(double value, std::span<const double> gradient)>;

FunctionBand band_of(std::string function, const Law& law, double from, double to,
                     const Spread& spread) {
  FunctionBand band{.function = std::move(function)};
  band.valid_from = from;
  band.valid_to = to;
  std::vector<double> gradient(law.spec().coefficients.size());
  for (auto* column : {&band.argument, &band.value, &band.lower, &band.upper}) {
    column->reserve(kPoints);
  }
  for (const double x : band_arguments(from, to)) {
    const double value = law.value(x);
    law.gradient(x, gradient);
    const Ends ends = spread(value, gradient);
    band.argument.push_back(x);
    band.value.push_back(value);
    band.lower.push_back(ends.lower);
    band.upper.push_back(ends.upper);
  }
  return band;
}

Spread symmetric(Eigen::MatrixXd covariance) {
  return [covariance = std::move(covariance)](double value, std::span<const double> gradient) {
    const double half = kNormal95 * standard_deviation(covariance, gradient);
    return Ends{value - half, value + half};
  };
}

// `off` holds draws less the estimate, a column a coefficient.
Spread drawn(Eigen::MatrixXd off) {
  return [off = std::move(off)](double value, std::span<const double> gradient) {
    const Eigen::Map<const Eigen::VectorXd> g(gradient.data(), off.cols());
    Eigen::VectorXd change = off * g;
    const auto place = [&](double share) {
      const auto k = static_cast<Eigen::Index>(share * static_cast<double>(change.size() - 1));
      std::nth_element(change.begin(), change.begin() + k, change.end());
      return change[k];
    };
    const double low = place(0.025);
    const double high = place(0.975);
    return Ends{value + std::min(low, 0.0), value + std::max(high, 0.0)};
  };
}

std::vector<FunctionBand> bands_of(const TorsionLayout& layout, std::span<const double> p,
                                   const Domain& domain,
                                   const std::function<Spread(const Group&)>& spread) {
  std::vector<FunctionBand> bands;
  const auto f = make_law(layout.f(p));
  const auto g_inverse = make_law(layout.g_inverse(p));
  const auto h = make_law(layout.h(p));
  expects(f && g_inverse && h, "the laws of an estimate can be made");
  bands.push_back(band_of("f", **f, domain.motion_from, domain.motion_to, spread(layout.f_group)));
  bands.push_back(
      band_of("g_inverse", **g_inverse, -domain.velocity, domain.velocity, spread(layout.g_group)));
  if (layout.h_group.present()) {
    bands.push_back(
        band_of("h", **h, domain.motion_from, domain.motion_to, spread(layout.h_group)));
  }
  return bands;
}

}  // namespace

std::vector<double> band_arguments(double from, double to) {
  const double middle = 0.5 * (from + to);
  const double half = 0.5 * (to - from) * kBeyond;
  std::vector<double> list;
  for (int k = 0; k < kPoints; ++k) list.push_back(middle + half * (2.0 * k / (kPoints - 1) - 1.0));
  return list;
}

FunctionBand law_band(std::string function, const Law& law, const Eigen::MatrixXd& covariance,
                      double from, double to) {
  return band_of(std::move(function), law, from, to, symmetric(covariance));
}

std::vector<FunctionBand> torsion_bands(const TorsionLayout& layout, std::span<const double> p,
                                        const Eigen::MatrixXd& covariance, const Domain& domain) {
  return bands_of(layout, p, domain, [&](const Group& group) {
    const auto first = static_cast<Eigen::Index>(group.first);
    const auto count = static_cast<Eigen::Index>(group.count);
    return symmetric(covariance.block(first, first, count, count));
  });
}

std::vector<FunctionBand> torsion_bands(const TorsionLayout& layout, std::span<const double> p,
                                        const Eigen::MatrixXd& draws, const Domain& domain,
                                        DrawnBands) {
  const Eigen::Map<const Eigen::RowVectorXd> at(p.data(), static_cast<Eigen::Index>(p.size()));
  const Eigen::MatrixXd off = draws.rowwise() - at;
  return bands_of(layout, p, domain, [&](const Group& group) {
    return drawn(off.middleCols(static_cast<Eigen::Index>(group.first),
                                static_cast<Eigen::Index>(group.count)));
  });
}

}  // namespace flexspline::estimators
