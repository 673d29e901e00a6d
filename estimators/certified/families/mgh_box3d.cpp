#include "certified/mgh_problem.hpp"

namespace flexspline::estimators {

CertifiedFamily describe_mgh_box3d();

namespace {

using namespace certified;

struct Model {
  static constexpr std::size_t kParameters = 3;

  std::size_t size() const { return 3; }
  template <class S>
  S residual(std::size_t i, const std::array<S, kParameters>& x) const {
    const double t = 0.1 * static_cast<double>(i + 1);
    return exp(-t * x[0]) - exp(-t * x[1]) - x[2] * (std::exp(-t) - std::exp(-10.0 * t));
  }
};

}  // namespace

CertifiedFamily describe_mgh_box3d() {
  return {.id = "mgh_box3d",
          .model = "exp(-t x1) - exp(-t x2) - x3 (exp(-t) - exp(-10 t))",
          .source = kMgh,
          .problems = mgh_problems<Model>({.id = "Box 3-D",
                                           .start = {0.0, 10.0, 20.0},
                                           .sum_of_squares = 0.0,
                                           .lower = {0.0, 5.0, 0.0},
                                           .upper = {2.0, 9.5, 20.0},
                                           .bounded_sum_of_squares = 0.30998153e-5})};
}

}  // namespace flexspline::estimators
