#include "certified/nist_problem.hpp"

namespace flexspline::estimators {

CertifiedFamily describe_chwirut();

namespace {

using namespace certified;

struct Chwirut {
  static constexpr std::size_t kParameters = 3;
  template <class S>
  static S value(const std::array<S, kParameters>& b, double x) {
    return exp(-b[0] * x) / (b[1] + b[2] * x);
  }
};

}  // namespace

CertifiedFamily describe_chwirut() {
  return {.id = "chwirut",
          .model = "exp(-b1 x)/(b2 + b3 x)",
          .source = kNist,
          .problems = {nist_problem<Chwirut>("Chwirut1"), nist_problem<Chwirut>("Chwirut2")}};
}

}  // namespace flexspline::estimators
