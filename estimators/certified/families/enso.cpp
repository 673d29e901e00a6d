#include "certified/nist_problem.hpp"

namespace flexspline::estimators {

CertifiedFamily describe_enso();

namespace {

using namespace certified;

constexpr double kTurn = 6.283185307179586;

template <class S>
S cycle(const S& cosine, const S& sine, const S& period, double x) {
  const S angle = kTurn * x / period;
  return cosine * cos(angle) + sine * sin(angle);
}

struct Enso {
  static constexpr std::size_t kParameters = 9;
  template <class S>
  static S value(const std::array<S, kParameters>& b, double x) {
    return b[0] + cycle(b[1], b[2], S(12.0), x) + cycle(b[4], b[5], b[3], x) +
           cycle(b[7], b[8], b[6], x);
  }
};

}  // namespace

CertifiedFamily describe_enso() {
  return {.id = "enso",
          .model = "b1 + three cycles, one of a year and two of unknown period",
          .source = kNist,
          .problems = {nist_problem<Enso>("ENSO")}};
}

}  // namespace flexspline::estimators
