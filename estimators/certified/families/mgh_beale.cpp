#include "certified/mgh_problem.hpp"

namespace flexspline::estimators {

CertifiedFamily describe_mgh_beale();

namespace {

using namespace certified;

struct Model {
  static constexpr std::size_t kParameters = 2;

  std::size_t size() const { return 3; }
  template <class S>
  S residual(std::size_t i, const std::array<S, kParameters>& x) const {
    constexpr double kY[] = {1.5, 2.25, 2.625};
    S power = x[1];
    for (std::size_t k = 0; k < i; ++k) power = power * x[1];
    return kY[i] - x[0] * (1.0 - power);
  }
};

}  // namespace

CertifiedFamily describe_mgh_beale() {
  return {.id = "mgh_beale",
          .model = "y - x1 (1 - x2^i)",
          .source = kMgh,
          .problems = mgh_problems<Model>({.id = "Beale",
                                           .start = {1.0, 1.0},
                                           .sum_of_squares = 0.0,
                                           .lower = {0.6, 0.5},
                                           .upper = {10.0, 100.0},
                                           .bounded_sum_of_squares = 0.0})};
}

}  // namespace flexspline::estimators
