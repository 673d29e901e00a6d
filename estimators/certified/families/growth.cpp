#include "certified/nist_problem.hpp"

namespace flexspline::estimators {

CertifiedFamily describe_growth();

namespace {

using namespace certified;

struct Logistic {
  static constexpr std::size_t kParameters = 3;
  template <class S>
  static S value(const std::array<S, kParameters>& b, double x) {
    return b[0] / (1.0 + exp(b[1] - b[2] * x));
  }
};

struct Richards {
  static constexpr std::size_t kParameters = 4;
  template <class S>
  static S value(const std::array<S, kParameters>& b, double x) {
    return b[0] / pow(1.0 + exp(b[1] - b[2] * x), 1.0 / b[3]);
  }
};

}  // namespace

CertifiedFamily describe_growth() {
  return {.id = "growth",
          .model = "b1/(1 + exp(b2 - b3 x)) and its power 1/b4",
          .source = kNist,
          .problems = {nist_problem<Logistic>("Rat42"), nist_problem<Richards>("Rat43")}};
}

}  // namespace flexspline::estimators
