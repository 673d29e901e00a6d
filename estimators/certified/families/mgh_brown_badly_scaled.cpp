#include "certified/mgh_problem.hpp"

namespace flexspline::estimators {

CertifiedFamily describe_mgh_brown_badly_scaled();

namespace {

using namespace certified;

struct Model {
  static constexpr std::size_t kParameters = 2;

  std::size_t size() const { return 3; }
  template <class S>
  S residual(std::size_t i, const std::array<S, kParameters>& x) const {
    if (i == 0) return x[0] - 1e6;
    return i == 1 ? x[1] - 2e-6 : x[0] * x[1] - 2.0;
  }
};

}  // namespace

CertifiedFamily describe_mgh_brown_badly_scaled() {
  return {.id = "mgh_brown_badly_scaled",
          .model = "x1 - 1e6, x2 - 2e-6, x1 x2 - 2",
          .source = kMgh,
          .problems = mgh_problems<Model>({.id = "Brown badly scaled",
                                           .start = {1.0, 1.0},
                                           .sum_of_squares = 0.0,
                                           .lower = {0.0, 0.00003},
                                           .upper = {1000000.0, 100.0},
                                           .bounded_sum_of_squares = 0.784e3})};
}

}  // namespace flexspline::estimators
