#include "certified/mgh_problem.hpp"

namespace flexspline::estimators {

CertifiedFamily describe_mgh_wood();

namespace {

using namespace certified;

struct Model {
  static constexpr std::size_t kParameters = 4;

  std::size_t size() const { return 6; }
  template <class S>
  S residual(std::size_t i, const std::array<S, kParameters>& x) const {
    switch (i) {
      case 0:
        return 10.0 * (x[1] - x[0] * x[0]);
      case 1:
        return 1.0 - x[0];
      case 2:
        return std::sqrt(90.0) * (x[3] - x[2] * x[2]);
      case 3:
        return 1.0 - x[2];
      case 4:
        return std::sqrt(10.0) * (x[1] + x[3] - 2.0);
      default:
        return (x[1] - x[3]) / std::sqrt(10.0);
    }
  }
};

}  // namespace

CertifiedFamily describe_mgh_wood() {
  return {.id = "mgh_wood",
          .model = "Rosenbrock twice, with two residuals that couple them",
          .source = kMgh,
          .problems = mgh_problems<Model>({.id = "Wood",
                                           .start = {-3.0, -1.0, -3.0, -1.0},
                                           .sum_of_squares = 0.0,
                                           .lower = {-100.0, -100.0, -100.0, -100.0},
                                           .upper = {0.0, 10.0, 100.0, 100.0},
                                           .bounded_sum_of_squares = 0.15567008e1})};
}

}  // namespace flexspline::estimators
