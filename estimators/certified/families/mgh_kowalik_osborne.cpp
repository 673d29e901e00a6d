#include "certified/mgh_problem.hpp"

namespace flexspline::estimators {

CertifiedFamily describe_mgh_kowalik_osborne();

namespace {

using namespace certified;

constexpr double kY[] = {0.1957, 0.1947, 0.1735, 0.1600, 0.0844, 0.0627,
                         0.0456, 0.0342, 0.0323, 0.0235, 0.0246};
constexpr double kU[] = {4, 2, 1, 0.5, 0.25, 0.167, 0.125, 0.1, 0.0833, 0.0714, 0.0625};

struct Model {
  static constexpr std::size_t kParameters = 4;

  std::size_t size() const { return 11; }
  template <class S>
  S residual(std::size_t i, const std::array<S, kParameters>& x) const {
    const double u = kU[i];
    return kY[i] - x[0] * u * (u + x[1]) / (u * (u + x[2]) + x[3]);
  }
};

}  // namespace

CertifiedFamily describe_mgh_kowalik_osborne() {
  return {.id = "mgh_kowalik_osborne",
          .model = "y - x1 (u^2 + u x2)/(u^2 + u x3 + x4)",
          .source = kMgh,
          .problems = mgh_problems<Model>({.id = "Kowalik-Osborne",
                                           .start = {0.25, 0.39, 0.415, 0.39},
                                           .sum_of_squares = 3.07505e-4,
                                           .other_minima = {1.02734e-3}})};
}

}  // namespace flexspline::estimators
