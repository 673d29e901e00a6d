#include "certified/mgh_problem.hpp"

namespace flexspline::estimators {

CertifiedFamily describe_mgh_jennrich_sampson();

namespace {

using namespace certified;

struct Model {
  static constexpr std::size_t kParameters = 2;

  std::size_t size() const { return 10; }
  template <class S>
  S residual(std::size_t i, const std::array<S, kParameters>& x) const {
    const double t = static_cast<double>(i + 1);
    return 2.0 + 2.0 * t - exp(t * x[0]) - exp(t * x[1]);
  }
};

}  // namespace

CertifiedFamily describe_mgh_jennrich_sampson() {
  return {.id = "mgh_jennrich_sampson",
          .model = "2 + 2 i - exp(i x1) - exp(i x2)",
          .source = kMgh,
          .problems = mgh_problems<Model>(
              {.id = "Jennrich-Sampson", .start = {0.3, 0.4}, .sum_of_squares = 124.362})};
}

}  // namespace flexspline::estimators
