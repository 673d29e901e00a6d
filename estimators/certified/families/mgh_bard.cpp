#include <algorithm>

#include "certified/mgh_problem.hpp"

namespace flexspline::estimators {

CertifiedFamily describe_mgh_bard();

namespace {

using namespace certified;

constexpr double kY[] = {0.14, 0.18, 0.22, 0.25, 0.29, 0.32, 0.35, 0.39,
                         0.37, 0.58, 0.73, 0.96, 1.34, 2.10, 4.39};

struct Model {
  static constexpr std::size_t kParameters = 3;

  std::size_t size() const { return 15; }
  template <class S>
  S residual(std::size_t i, const std::array<S, kParameters>& x) const {
    const double u = static_cast<double>(i + 1);
    const double v = 16.0 - u;
    return kY[i] - (x[0] + u / (v * x[1] + std::min(u, v) * x[2]));
  }
};

}  // namespace

CertifiedFamily describe_mgh_bard() {
  return {.id = "mgh_bard",
          .model = "y - x1 - u/(v x2 + w x3)",
          .source = kMgh,
          .problems = mgh_problems<Model>({.id = "Bard",
                                           .start = {1.0, 1.0, 1.0},
                                           .sum_of_squares = 8.21487e-3,
                                           .other_minima = {17.4286}})};
}

}  // namespace flexspline::estimators
