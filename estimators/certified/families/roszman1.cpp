#include "certified/nist_problem.hpp"

namespace flexspline::estimators {

CertifiedFamily describe_roszman1();

namespace {

using namespace certified;

// NIST means the principal value: with atan2 b1 would be larger by 1.
constexpr double kPi = 3.141592653589793;

struct Roszman1 {
  static constexpr std::size_t kParameters = 4;
  template <class S>
  static S value(const std::array<S, kParameters>& b, double x) {
    return b[0] - b[1] * x - atan(b[2] / (x - b[3])) / kPi;
  }
};

}  // namespace

CertifiedFamily describe_roszman1() {
  return {.id = "roszman1",
          .model = "b1 - b2 x - atan(b3/(x - b4))/pi",
          .source = kNist,
          .problems = {nist_problem<Roszman1>("Roszman1")}};
}

}  // namespace flexspline::estimators
