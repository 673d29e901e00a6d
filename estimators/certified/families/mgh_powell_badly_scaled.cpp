#include "certified/mgh_problem.hpp"

namespace flexspline::estimators {

CertifiedFamily describe_mgh_powell_badly_scaled();

namespace {

using namespace certified;

struct Model {
  static constexpr std::size_t kParameters = 2;

  std::size_t size() const { return 2; }
  template <class S>
  S residual(std::size_t i, const std::array<S, kParameters>& x) const {
    return i == 0 ? 1e4 * x[0] * x[1] - 1.0 : exp(-x[0]) + exp(-x[1]) - 1.0001;
  }
};

}  // namespace

CertifiedFamily describe_mgh_powell_badly_scaled() {
  return {.id = "mgh_powell_badly_scaled",
          .model = "1e4 x1 x2 - 1, exp(-x1) + exp(-x2) - 1.0001",
          .source = kMgh,
          .problems = mgh_problems<Model>({.id = "Powell badly scaled",
                                           .start = {0.0, 1.0},
                                           .sum_of_squares = 0.0,
                                           .lower = {0.0, 1.0},
                                           .upper = {1.0, 9.0},
                                           .bounded_sum_of_squares = 0.151259e-9})};
}

}  // namespace flexspline::estimators
