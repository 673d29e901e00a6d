#include "certified/nist_problem.hpp"

namespace flexspline::estimators {

CertifiedFamily describe_misra1();

namespace {

using namespace certified;

struct Exponential {
  static constexpr std::size_t kParameters = 2;
  template <class S>
  static S value(const std::array<S, kParameters>& b, double x) {
    return b[0] * (1.0 - exp(-b[1] * x));
  }
};

struct SquareLaw {
  static constexpr std::size_t kParameters = 2;
  template <class S>
  static S value(const std::array<S, kParameters>& b, double x) {
    return b[0] * (1.0 - pow(1.0 + b[1] * x / 2.0, -2.0));
  }
};

struct RootLaw {
  static constexpr std::size_t kParameters = 2;
  template <class S>
  static S value(const std::array<S, kParameters>& b, double x) {
    return b[0] * (1.0 - pow(1.0 + 2.0 * b[1] * x, -0.5));
  }
};

struct Hyperbola {
  static constexpr std::size_t kParameters = 2;
  template <class S>
  static S value(const std::array<S, kParameters>& b, double x) {
    return b[0] * b[1] * x / (1.0 + b[1] * x);
  }
};

}  // namespace

CertifiedFamily describe_misra1() {
  return {.id = "misra1",
          .model =
              "saturation: b1 (1 - exp(-b2 x)), b1 (1 - (1 + b2 x/2)^-2), b1 (1 - (1 + 2 b2 "
              "x)^-1/2), b1 b2 x/(1 + b2 x)",
          .source = kNist,
          .problems = {nist_problem<Exponential>("Misra1a"), nist_problem<SquareLaw>("Misra1b"),
                       nist_problem<RootLaw>("Misra1c"), nist_problem<Hyperbola>("Misra1d"),
                       nist_problem<Exponential>("BoxBOD")}};
}

}  // namespace flexspline::estimators
