#include "certified/nist_problem.hpp"

namespace flexspline::estimators {

CertifiedFamily describe_gauss();

namespace {

using namespace certified;

struct Gauss {
  static constexpr std::size_t kParameters = 8;
  template <class S>
  static S value(const std::array<S, kParameters>& b, double x) {
    return b[0] * exp(-b[1] * x) + b[2] * exp(-square((x - b[3]) / b[4])) +
           b[5] * exp(-square((x - b[6]) / b[7]));
  }
};

}  // namespace

CertifiedFamily describe_gauss() {
  return {.id = "gauss",
          .model = "b1 exp(-b2 x) + b3 exp(-(x - b4)^2/b5^2) + b6 exp(-(x - b7)^2/b8^2)",
          .source = kNist,
          .problems = {nist_problem<Gauss>("Gauss1"), nist_problem<Gauss>("Gauss2"),
                       nist_problem<Gauss>("Gauss3")}};
}

}  // namespace flexspline::estimators
