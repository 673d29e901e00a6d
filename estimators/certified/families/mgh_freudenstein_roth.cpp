#include "certified/mgh_problem.hpp"

namespace flexspline::estimators {

CertifiedFamily describe_mgh_freudenstein_roth();

namespace {

using namespace certified;

struct Model {
  static constexpr std::size_t kParameters = 2;

  std::size_t size() const { return 2; }
  template <class S>
  S residual(std::size_t i, const std::array<S, kParameters>& x) const {
    if (i == 0) return x[0] - 13.0 + ((5.0 - x[1]) * x[1] - 2.0) * x[1];
    return x[0] - 29.0 + ((x[1] + 1.0) * x[1] - 14.0) * x[1];
  }
};

}  // namespace

CertifiedFamily describe_mgh_freudenstein_roth() {
  return {.id = "mgh_freudenstein_roth",
          .model = "x1 - 13 + ((5 - x2) x2 - 2) x2, x1 - 29 + ((x2 + 1) x2 - 14) x2",
          .source = kMgh,
          .problems = mgh_problems<Model>({.id = "Freudenstein-Roth",
                                           .start = {0.5, -2.0},
                                           .sum_of_squares = 0.0,
                                           .other_minima = {48.98425}})};
}

}  // namespace flexspline::estimators
