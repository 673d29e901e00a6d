#include "certified/mgh_problem.hpp"

namespace flexspline::estimators {

CertifiedFamily describe_mgh_powell_singular();

namespace {

using namespace certified;

struct Model {
  static constexpr std::size_t kParameters = 4;

  std::size_t size() const { return 4; }
  template <class S>
  S residual(std::size_t i, const std::array<S, kParameters>& x) const {
    switch (i) {
      case 0:
        return x[0] + 10.0 * x[1];
      case 1:
        return std::sqrt(5.0) * (x[2] - x[3]);
      case 2:
        return square(x[1] - 2.0 * x[2]);
      default:
        return std::sqrt(10.0) * square(x[0] - x[3]);
    }
  }
};

}  // namespace

CertifiedFamily describe_mgh_powell_singular() {
  return {.id = "mgh_powell_singular",
          .model = "x1 + 10 x2, sqrt(5) (x3 - x4), (x2 - 2 x3)^2, sqrt(10) (x1 - x4)^2",
          .source = kMgh,
          .problems = mgh_problems<Model>(
              {.id = "Powell singular", .start = {3.0, -1.0, 0.0, 1.0}, .sum_of_squares = 0.0})};
}

}  // namespace flexspline::estimators
