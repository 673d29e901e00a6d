#include "certified/mgh_problem.hpp"

namespace flexspline::estimators {

CertifiedFamily describe_mgh_rosenbrock();

namespace {

using namespace certified;

struct Model {
  static constexpr std::size_t kParameters = 2;

  std::size_t size() const { return 2; }
  template <class S>
  S residual(std::size_t i, const std::array<S, kParameters>& x) const {
    return i == 0 ? 10.0 * (x[1] - x[0] * x[0]) : 1.0 - x[0];
  }
};

}  // namespace

CertifiedFamily describe_mgh_rosenbrock() {
  return {.id = "mgh_rosenbrock",
          .model = "10 (x2 - x1^2), 1 - x1",
          .source = kMgh,
          .problems = mgh_problems<Model>(
              {.id = "Rosenbrock", .start = {-1.2, 1.0}, .sum_of_squares = 0.0})};
}

}  // namespace flexspline::estimators
