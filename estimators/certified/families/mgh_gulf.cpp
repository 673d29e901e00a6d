#include "certified/mgh_problem.hpp"

namespace flexspline::estimators {

CertifiedFamily describe_mgh_gulf();

namespace {

using namespace certified;

// Without Gay's bounds: their published minimum, 5.8e-5, is not one of this function, whose minimum
// within them lies at (10, 10, 0.6145) with a sum of squares of 5.29.
struct Model {
  static constexpr std::size_t kParameters = 3;

  std::size_t size() const { return 100; }
  template <class S>
  S residual(std::size_t i, const std::array<S, kParameters>& x) const {
    const double t = static_cast<double>(i + 1) / 100.0;
    const S distance = 25.0 + std::pow(-50.0 * std::log(t), 2.0 / 3.0) - x[1];
    const S magnitude = flexspline::magnitude(distance);
    if (real_part(magnitude) == 0.0) return S(1.0 - t);  // where log has no value but the power has
    return exp(-pow(magnitude, x[2]) / x[0]) - t;
  }
};

}  // namespace

CertifiedFamily describe_mgh_gulf() {
  return {.id = "mgh_gulf",
          .model = "exp(-|y - x2|^x3/x1) - t",
          .source = kMgh,
          .problems = mgh_problems<Model>(
              {.id = "Gulf research", .start = {5.0, 2.5, 0.15}, .sum_of_squares = 0.0})};
}

}  // namespace flexspline::estimators
