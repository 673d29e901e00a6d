#include "certified/mgh_problem.hpp"

namespace flexspline::estimators {

CertifiedFamily describe_mgh_osborne1();

namespace {

using namespace certified;

constexpr double kY[] = {0.844, 0.908, 0.932, 0.936, 0.925, 0.908, 0.881, 0.850, 0.818,
                         0.784, 0.751, 0.718, 0.685, 0.658, 0.628, 0.603, 0.580, 0.558,
                         0.538, 0.522, 0.506, 0.490, 0.478, 0.467, 0.457, 0.448, 0.438,
                         0.431, 0.424, 0.420, 0.414, 0.411, 0.406};

struct Model {
  static constexpr std::size_t kParameters = 5;

  std::size_t size() const { return 33; }
  template <class S>
  S residual(std::size_t i, const std::array<S, kParameters>& x) const {
    const double t = 10.0 * static_cast<double>(i);
    return kY[i] - (x[0] + x[1] * exp(-t * x[3]) + x[2] * exp(-t * x[4]));
  }
};

}  // namespace

CertifiedFamily describe_mgh_osborne1() {
  return {.id = "mgh_osborne1",
          .model = "y - x1 - x2 exp(-t x4) - x3 exp(-t x5)",
          .source = kMgh,
          .problems = mgh_problems<Model>({.id = "Osborne 1",
                                           .start = {0.5, 1.5, -1.0, 0.01, 0.02},
                                           .sum_of_squares = 5.46489e-5})};
}

}  // namespace flexspline::estimators
