#include "certified/nist_problem.hpp"

namespace flexspline::estimators {

CertifiedFamily describe_eckerle4();

namespace {

using namespace certified;

struct Eckerle4 {
  static constexpr std::size_t kParameters = 3;
  template <class S>
  static S value(const std::array<S, kParameters>& b, double x) {
    return b[0] / b[1] * exp(-0.5 * square((x - b[2]) / b[1]));
  }
};

}  // namespace

CertifiedFamily describe_eckerle4() {
  return {.id = "eckerle4",
          .model = "(b1/b2) exp(-((x - b3)/b2)^2/2)",
          .source = kNist,
          .problems = {nist_problem<Eckerle4>("Eckerle4")}};
}

}  // namespace flexspline::estimators
