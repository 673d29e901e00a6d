#include "certified/nist_problem.hpp"

namespace flexspline::estimators {

CertifiedFamily describe_mgh10();

namespace {

using namespace certified;

struct Mgh10 {
  static constexpr std::size_t kParameters = 3;
  template <class S>
  static S value(const std::array<S, kParameters>& b, double x) {
    return b[0] * exp(b[1] / (x + b[2]));
  }
};

}  // namespace

CertifiedFamily describe_mgh10() {
  return {.id = "mgh10",
          .model = "b1 exp(b2/(x + b3))",
          .source = kNist,
          .problems = {nist_problem<Mgh10>("MGH10")}};
}

}  // namespace flexspline::estimators
