#include "certified/nist_problem.hpp"

namespace flexspline::estimators {

CertifiedFamily describe_mgh09();

namespace {

using namespace certified;

struct Mgh09 {
  static constexpr std::size_t kParameters = 4;
  template <class S>
  static S value(const std::array<S, kParameters>& b, double x) {
    return b[0] * x * (x + b[1]) / (x * (x + b[2]) + b[3]);
  }
};

}  // namespace

CertifiedFamily describe_mgh09() {
  return {.id = "mgh09",
          .model = "b1 (x^2 + b2 x)/(x^2 + b3 x + b4)",
          .source = kNist,
          .problems = {nist_problem<Mgh09>("MGH09")}};
}

}  // namespace flexspline::estimators
