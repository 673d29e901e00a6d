#include "flexspline/estimators/polynomial_torsion.hpp"

#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "ode_fit/bernstein.hpp"

namespace flexspline::estimators {
namespace {

constexpr double kProved = 1e-9;  // of the least values
constexpr double kMet = 1e-8;     // a limit that is fallen short of by no more is met

/// What holds of a function on all of [0, 1] whose polynomial in the square of its argument is
/// given; `sign` -1 for an upper limit.
std::string held(const char* name, std::vector<double> in_square, double limit, double sign) {
  for (double& c : in_square) c *= sign;
  const PolynomialLeast least = least_on_unit(in_square, kProved);
  const double extreme = sign * least.value;
  const char* relation = sign > 0.0 ? ">=" : "<=";
  if (least.value >= sign * limit - kMet) {
    return fmt::format("{} {} {:.4g} on all of [0, 1] (proved, extreme {:.6g})", name, relation,
                       limit, extreme);
  }
  return fmt::format(
      "{} {} {:.4g} holds at the points alone: between them it reaches {:.6g} at {:.4g}", name,
      relation, limit, extreme, std::sqrt(least.at));
}

std::vector<double> slope_in_square(std::span<const double> c) {
  std::vector<double> result;
  for (std::size_t k = 0; k < c.size(); ++k)
    result.push_back((2.0 * static_cast<double>(k) + 1.0) * c[k]);
  return result;
}

}  // namespace

std::vector<std::string> PolynomialTorsionLimits::between(std::span<const double> p) const {
  std::vector<std::string> list = {
      held("f'", slope_in_square(p.first(shape_.f)), limits_.slope, 1.0),
      held("g'", slope_in_square(p.subspan(shape_.f, shape_.g)), limits_.slope, 1.0)};
  if (shape_.h == 0) return list;
  std::vector<double> log_h = {0.0};
  const auto h = p.subspan(shape_.f + shape_.g);
  log_h.insert(log_h.end(), h.begin(), h.end());
  list.push_back(held("ln h", log_h, std::log(limits_.lowest_h), 1.0));
  list.push_back(held("ln h", log_h, std::log(limits_.highest_h), -1.0));
  return list;
}

std::string PolynomialTorsionLimits::name(std::size_t i) const {
  static constexpr const char* kNames[] = {"f' at x", "g' at z", "ln h at x"};
  return fmt::format("{} = {:.3g}", kNames[i / limits_.points], at(i % limits_.points));
}

double PolynomialTorsionLimits::lower(std::size_t i) const {
  return i / limits_.points < 2 ? limits_.slope : std::log(limits_.lowest_h);
}

double PolynomialTorsionLimits::upper(std::size_t i) const {
  return i / limits_.points < 2 ? std::numeric_limits<double>::infinity()
                                : std::log(limits_.highest_h);
}

}  // namespace flexspline::estimators
