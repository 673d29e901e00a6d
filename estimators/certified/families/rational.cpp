#include "certified/nist_problem.hpp"

namespace flexspline::estimators {

CertifiedFamily describe_rational();

namespace {

using namespace certified;

struct Cubic {
  static constexpr std::size_t kParameters = 7;
  template <class S>
  static S value(const std::array<S, kParameters>& b, double x) {
    return (b[0] + x * (b[1] + x * (b[2] + x * b[3]))) / (1.0 + x * (b[4] + x * (b[5] + x * b[6])));
  }
};

struct Quadratic {
  static constexpr std::size_t kParameters = 5;
  template <class S>
  static S value(const std::array<S, kParameters>& b, double x) {
    return (b[0] + x * (b[1] + x * b[2])) / (1.0 + x * (b[3] + x * b[4]));
  }
};

}  // namespace

CertifiedFamily describe_rational() {
  return {.id = "rational",
          .model = "quotients of polynomials, cubic and quadratic",
          .source = kNist,
          .problems = {nist_problem<Cubic>("Hahn1"), nist_problem<Cubic>("Thurber"),
                       nist_problem<Quadratic>("Kirby2")}};
}

}  // namespace flexspline::estimators
