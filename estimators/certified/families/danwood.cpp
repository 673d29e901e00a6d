#include "certified/nist_problem.hpp"

namespace flexspline::estimators {

CertifiedFamily describe_danwood();

namespace {

using namespace certified;

struct Power {
  static constexpr std::size_t kParameters = 2;
  template <class S>
  static S value(const std::array<S, kParameters>& b, double x) {
    return b[0] * exp(b[1] * std::log(x));
  }
};

}  // namespace

CertifiedFamily describe_danwood() {
  return {.id = "danwood",
          .model = "b1 x^b2",
          .source = kNist,
          .problems = {nist_problem<Power>("DanWood")}};
}

}  // namespace flexspline::estimators
