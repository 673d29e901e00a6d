#include "certified/nist_problem.hpp"

namespace flexspline::estimators {

CertifiedFamily describe_nelson();

namespace {

using namespace certified;

// The one model of log y, and of two predictors.
struct Nelson {
  static constexpr std::size_t kParameters = 3;
  NistData data;

  std::size_t size() const { return data.y.size(); }
  template <class S>
  S residual(std::size_t i, const std::array<S, kParameters>& b) const {
    return std::log(data.y[i]) - (b[0] - b[1] * data.x[i][0] * exp(-b[2] * data.x[i][1]));
  }
};

}  // namespace

CertifiedFamily describe_nelson() {
  return {.id = "nelson",
          .model = "log y = b1 - b2 x1 exp(-b3 x2)",
          .source = kNist,
          .problems = {nist_problem_of<Nelson>("Nelson")}};
}

}  // namespace flexspline::estimators
