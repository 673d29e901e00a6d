#include "certified/mgh_problem.hpp"

namespace flexspline::estimators {

CertifiedFamily describe_mgh_brown_dennis();

namespace {

using namespace certified;

struct Model {
  static constexpr std::size_t kParameters = 4;

  std::size_t size() const { return 20; }
  template <class S>
  S residual(std::size_t i, const std::array<S, kParameters>& x) const {
    const double t = static_cast<double>(i + 1) / 5.0;
    return square(x[0] + t * x[1] - std::exp(t)) + square(x[2] + x[3] * std::sin(t) - std::cos(t));
  }
};

}  // namespace

CertifiedFamily describe_mgh_brown_dennis() {
  return {.id = "mgh_brown_dennis",
          .model = "(x1 + t x2 - exp t)^2 + (x3 + x4 sin t - cos t)^2",
          .source = kMgh,
          .problems = mgh_problems<Model>({.id = "Brown-Dennis",
                                           .start = {25.0, 5.0, -5.0, -1.0},
                                           .sum_of_squares = 85822.2,
                                           .lower = {-10.0, 0.0, -100.0, -20.0},
                                           .upper = {100.0, 15.0, 0.0, 0.2},
                                           .bounded_sum_of_squares = 0.88860479e5})};
}

}  // namespace flexspline::estimators
