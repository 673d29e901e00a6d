#include "certified/nist_problem.hpp"

namespace flexspline::estimators {

CertifiedFamily describe_lanczos();

namespace {

using namespace certified;

struct Lanczos {
  static constexpr std::size_t kParameters = 6;
  template <class S>
  static S value(const std::array<S, kParameters>& b, double x) {
    return b[0] * exp(-b[1] * x) + b[2] * exp(-b[3] * x) + b[4] * exp(-b[5] * x);
  }
};

// The certified sum of squares, 1.4e-25, is below what parameters of 11 digits can express (4e-21),
// so the first is judged by its parameters alone.
CertifiedProblem lanczos1() {
  CertifiedProblem problem = nist_problem<Lanczos>("Lanczos1");
  problem.sum_of_squares = kNotComputed;
  return problem;
}

}  // namespace

CertifiedFamily describe_lanczos() {
  return {.id = "lanczos",
          .model = "b1 exp(-b2 x) + b3 exp(-b4 x) + b5 exp(-b6 x)",
          .source = kNist,
          .problems = {lanczos1(), nist_problem<Lanczos>("Lanczos2"),
                       nist_problem<Lanczos>("Lanczos3")}};
}

}  // namespace flexspline::estimators
