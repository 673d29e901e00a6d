#include "certified/mgh_problem.hpp"

namespace flexspline::estimators {

CertifiedFamily describe_mgh_helical_valley();

namespace {

using namespace certified;

struct Model {
  static constexpr std::size_t kParameters = 3;

  std::size_t size() const { return 3; }
  template <class S>
  S residual(std::size_t i, const std::array<S, kParameters>& x) const {
    if (i == 2) return x[2];
    if (i == 1) return 10.0 * (sqrt(x[0] * x[0] + x[1] * x[1]) - 1.0);
    const S turns = atan(x[1] / x[0]) / 6.283185307179586 + (real_part(x[0]) < 0.0 ? 0.5 : 0.0);
    return 10.0 * (x[2] - 10.0 * turns);
  }
};

}  // namespace

CertifiedFamily describe_mgh_helical_valley() {
  return {.id = "mgh_helical_valley",
          .model = "10 (x3 - 10 theta), 10 (sqrt(x1^2 + x2^2) - 1), x3",
          .source = kMgh,
          .problems = mgh_problems<Model>({.id = "Helical valley",
                                           .start = {-1.0, 0.0, 0.0},
                                           .sum_of_squares = 0.0,
                                           .lower = {-100.0, -1.0, -1.0},
                                           .upper = {0.8, 1.0, 1.0},
                                           .bounded_sum_of_squares = 0.99042212})};
}

}  // namespace flexspline::estimators
