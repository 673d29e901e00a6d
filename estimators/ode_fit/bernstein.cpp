#include "ode_fit/bernstein.hpp"

#include <algorithm>
#include <vector>

namespace flexspline::estimators {
namespace {

constexpr int kDeepest = 60;  // halvings: rounding is reached before

/// b_i = sum_{k<=i} C(i,k)/C(n,k) c_k.
std::vector<double> bernstein(std::span<const double> c) {
  std::vector<double> b(c.begin(), c.end());
  const auto n = static_cast<double>(c.size()) - 1.0;
  double binomial = 1.0;
  for (std::size_t k = 1; k < b.size(); ++k) {
    binomial *= (n - static_cast<double>(k) + 1.0) / static_cast<double>(k);
    b[k] /= binomial;
  }
  for (std::size_t level = 1; level < b.size(); ++level) {
    for (std::size_t i = b.size() - 1; i >= level; --i) b[i] += b[i - 1];
  }
  return b;
}

struct Search {
  double tolerance;
  PolynomialLeast best;

  void take(double value, double at) {
    if (value < best.value) best = {value, at};
  }

  void over(const std::vector<double>& b, double from, double to, int depth) {
    take(b.front(), from);
    take(b.back(), to);
    if (*std::ranges::min_element(b) >= best.value - tolerance || depth == kDeepest) return;
    std::vector<double> left{b.front()};
    std::vector<double> right = b;
    for (std::size_t level = 1; level < b.size(); ++level) {  // de Casteljau
      for (std::size_t i = 0; i + level < b.size(); ++i) right[i] = 0.5 * (right[i] + right[i + 1]);
      left.push_back(right.front());
    }
    const double middle = 0.5 * (from + to);
    over(left, from, middle, depth + 1);
    over(right, middle, to, depth + 1);
  }
};

}  // namespace

PolynomialLeast least_on_unit(std::span<const double> coefficients, double tolerance) {
  if (coefficients.empty()) return {};
  const std::vector<double> b = bernstein(coefficients);
  Search search{tolerance, {b.front(), 0.0}};
  search.over(b, 0.0, 1.0, 0);
  return search.best;
}

}  // namespace flexspline::estimators
