#include "certified/mgh_problem.hpp"

namespace flexspline::estimators {

CertifiedFamily describe_mgh_gaussian();

namespace {

using namespace certified;

constexpr double kY[] = {0.0009, 0.0044, 0.0175, 0.0540, 0.1295, 0.2420, 0.3521, 0.3989,
                         0.3521, 0.2420, 0.1295, 0.0540, 0.0175, 0.0044, 0.0009};

struct Model {
  static constexpr std::size_t kParameters = 3;

  std::size_t size() const { return 15; }
  template <class S>
  S residual(std::size_t i, const std::array<S, kParameters>& x) const {
    const double t = (7.0 - static_cast<double>(i)) / 2.0;
    return x[0] * exp(-0.5 * x[1] * square(t - x[2])) - kY[i];
  }
};

}  // namespace

CertifiedFamily describe_mgh_gaussian() {
  return {.id = "mgh_gaussian",
          .model = "x1 exp(-x2 (t - x3)^2/2) - y",
          .source = kMgh,
          .problems = mgh_problems<Model>({.id = "Gaussian",
                                           .start = {0.4, 1.0, 0.0},
                                           .sum_of_squares = 0.112793e-7,
                                           .lower = {0.398, 1.0, -0.5},
                                           .upper = {4.2, 2.0, 0.1},
                                           .bounded_sum_of_squares = 0.112793e-7})};
}

}  // namespace flexspline::estimators
