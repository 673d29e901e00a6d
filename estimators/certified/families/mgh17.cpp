#include "certified/nist_problem.hpp"

namespace flexspline::estimators {

CertifiedFamily describe_mgh17();

namespace {

using namespace certified;

struct Mgh17 {
  static constexpr std::size_t kParameters = 5;
  template <class S>
  static S value(const std::array<S, kParameters>& b, double x) {
    return b[0] + b[1] * exp(-b[3] * x) + b[2] * exp(-b[4] * x);
  }
};

}  // namespace

CertifiedFamily describe_mgh17() {
  return {.id = "mgh17",
          .model = "b1 + b2 exp(-b4 x) + b3 exp(-b5 x)",
          .source = kNist,
          .problems = {nist_problem<Mgh17>("MGH17")}};
}

}  // namespace flexspline::estimators
