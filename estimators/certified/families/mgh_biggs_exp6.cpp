#include "certified/mgh_problem.hpp"

namespace flexspline::estimators {

CertifiedFamily describe_mgh_biggs_exp6();

namespace {

using namespace certified;

struct Model {
  static constexpr std::size_t kParameters = 6;

  std::size_t size() const { return 13; }
  template <class S>
  S residual(std::size_t i, const std::array<S, kParameters>& x) const {
    const double t = 0.1 * static_cast<double>(i + 1);
    const double y = std::exp(-t) - 5.0 * std::exp(-10.0 * t) + 3.0 * std::exp(-4.0 * t);
    return x[2] * exp(-t * x[0]) - x[3] * exp(-t * x[1]) + x[5] * exp(-t * x[4]) - y;
  }
};

}  // namespace

CertifiedFamily describe_mgh_biggs_exp6() {
  return {.id = "mgh_biggs_exp6",
          .model = "x3 exp(-t x1) - x4 exp(-t x2) + x6 exp(-t x5) - y",
          .source = kMgh,
          .problems = mgh_problems<Model>({.id = "Biggs EXP6",
                                           .start = {1.0, 2.0, 1.0, 1.0, 1.0, 1.0},
                                           .sum_of_squares = 0.0,
                                           .other_minima = {5.65565e-3},
                                           .lower = {0.0, 0.0, 0.0, 1.0, 0.0, 0.0},
                                           .upper = {2.0, 8.0, 1.0, 7.0, 5.0, 5.0},
                                           .bounded_sum_of_squares = 0.53209865e-3})};
}

}  // namespace flexspline::estimators
