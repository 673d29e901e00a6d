#include "certified/mgh_problem.hpp"

namespace flexspline::estimators {

CertifiedFamily describe_mgh_meyer();

namespace {

using namespace certified;

constexpr double kY[] = {34780, 28610, 23650, 19630, 16370, 13720, 11540, 9744,
                         8261,  7030,  6005,  5147,  4427,  3820,  3307,  2872};

struct Model {
  static constexpr std::size_t kParameters = 3;

  std::size_t size() const { return 16; }
  template <class S>
  S residual(std::size_t i, const std::array<S, kParameters>& x) const {
    const double t = 50.0 + 5.0 * static_cast<double>(i);
    return x[0] * exp(x[1] / (t + x[2])) - kY[i];
  }
};

}  // namespace

CertifiedFamily describe_mgh_meyer() {
  return {.id = "mgh_meyer",
          .model = "x1 exp(x2/(t + x3)) - y",
          .source = kMgh,
          .problems = mgh_problems<Model>(
              {.id = "Meyer", .start = {0.02, 4000.0, 250.0}, .sum_of_squares = 87.9458})};
}

}  // namespace flexspline::estimators
