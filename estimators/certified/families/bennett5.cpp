#include "certified/nist_problem.hpp"

namespace flexspline::estimators {

CertifiedFamily describe_bennett5();

namespace {

using namespace certified;

struct Bennett5 {
  static constexpr std::size_t kParameters = 3;
  template <class S>
  static S value(const std::array<S, kParameters>& b, double x) {
    return b[0] * pow(b[1] + x, -1.0 / b[2]);
  }
};

}  // namespace

CertifiedFamily describe_bennett5() {
  return {.id = "bennett5",
          .model = "b1 (b2 + x)^(-1/b3)",
          .source = kNist,
          .problems = {nist_problem<Bennett5>("Bennett5")}};
}

}  // namespace flexspline::estimators
