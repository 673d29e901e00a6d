#include "sanity/evidence.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <fmt/format.h>
#include <Eigen/Dense>

#include "sanity/observed.hpp"

namespace flexspline::data {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

constexpr double kDegrees = 180.0 / std::numbers::pi;
constexpr double kNear = 1.12;

struct Mistake {
  double factor;
  const char* large;  ///< what would make it
  const char* small;  ///< what would make its inverse
};

}  // namespace

bool is_off(double factor, double most) {
  return !(factor > 0.0) || std::abs(std::log(factor)) > std::log(most);
}

Agreement agreement_of(const std::vector<Factor>& factors, double most) {
  std::vector<double> values;
  for (const Factor& one : factors) values.push_back(one.value);
  Agreement agreement{median_of(values), {}};
  for (const Factor& one : factors) {
    if (is_off(one.value / agreement.common, most)) agreement.others.push_back(one);
  }
  return agreement;
}

std::string mistake_of(double factor, double ratio) {
  const double size = std::abs(factor);
  const std::array<Mistake, 6> mistakes = {{
      {kDegrees, "57.3 is degrees taken as radians", "1/57.3 is radians taken as degrees"},
      {1000.0, "1000 is a thousandth of the unit taken for the unit (mNm for Nm, ms for s)",
       "1/1000 is the unit taken for a thousandth of it (Nm for mNm, s for ms)"},
      {1e6, "1e6 is the square of ms taken for s", "1e-6 is the square of s taken for ms"},
      {ratio, "it is the gear ratio: the motor's side taken for the output's",
       "it is one over the gear ratio: the output's side taken for the motor's"},
      {ratio * ratio, "it is the square of the gear ratio: both shafts exchanged",
       "it is one over the square of the gear ratio: both shafts exchanged"},
      {2.0, "2 is a ratio halved, or a peak-to-peak value",
       "1/2 is a ratio doubled, or half of it"},
  }};
  for (const Mistake& one : mistakes) {
    if (!is_off(size / one.factor, kNear)) return one.large;
    if (!is_off(size * one.factor, kNear)) return one.small;
  }
  return factor < 0.0 && !is_off(size, 2.0) ? "one of the two has the wrong sign" : "";
}

bool is_mistaken_alone(double factor, double most) {
  const double size = std::abs(factor);
  return is_off(size, most * most) || (factor < 0.0 && !is_off(size, most));
}

Regression regression(const std::vector<ArrayXd>& columns, const ArrayXd& y,
                      const ArrayXd& usable) {
  const auto count = static_cast<Index>(columns.size());
  Eigen::MatrixXd a(y.size(), count);
  for (Index k = 0; k < count; ++k) a.col(k) = columns[static_cast<std::size_t>(k)] * usable;
  const Eigen::VectorXd scale = a.colwise().norm().cwiseMax(1e-300);
  a = a * scale.cwiseInverse().asDiagonal();
  const Eigen::VectorXd b = (y * usable).matrix();
  const Eigen::MatrixXd normal =
      a.transpose() * a + 1e-12 * Eigen::MatrixXd::Identity(count, count);
  const Eigen::LDLT<Eigen::MatrixXd> solver(normal);
  const Eigen::VectorXd solution = solver.solve(a.transpose() * b);
  const double rows = std::max(usable.sum(), 1.0);
  const double left = (b - a * solution).squaredNorm();
  const double mean = b.sum() / rows;
  const double variance = b.squaredNorm() - rows * mean * mean;
  const Eigen::VectorXd inverse = solver.solve(Eigen::MatrixXd::Identity(count, count)).diagonal();
  const double noise = std::sqrt(left / std::max(rows - static_cast<double>(count), 1.0));
  Regression fit;
  fit.coefficient = solution.cwiseQuotient(scale);
  fit.error = noise * inverse.cwiseMax(0.0).cwiseSqrt().cwiseQuotient(scale);
  fit.explained = variance > 0.0 ? 1.0 - left / variance : 0.0;
  return fit;
}

Regression nearer_to(double value, Regression a, Regression b) {
  const auto off = [&](const Regression& fit) {
    const double factor = fit.coefficient[0] / value;
    return factor > 0.0 ? std::abs(std::log(factor)) : std::numeric_limits<double>::infinity();
  };
  return off(b) < off(a) ? std::move(b) : std::move(a);
}

ArrayXd smooth_sign(const ArrayXd& x) {
  const double width = 0.2 * std::sqrt(x.square().mean());
  return width > 0.0 ? ArrayXd(x / (x.square() + width * width).sqrt()) : ArrayXd::Zero(x.size());
}

}  // namespace flexspline::data
