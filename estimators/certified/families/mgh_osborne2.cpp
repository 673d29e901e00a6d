#include "certified/mgh_problem.hpp"

namespace flexspline::estimators {

CertifiedFamily describe_mgh_osborne2();

namespace {

using namespace certified;

constexpr double kY[] = {
    1.366, 1.191, 1.112, 1.013, 0.991, 0.885, 0.831, 0.847, 0.786, 0.725, 0.746, 0.679, 0.608,
    0.655, 0.616, 0.606, 0.602, 0.626, 0.651, 0.724, 0.649, 0.649, 0.694, 0.644, 0.624, 0.661,
    0.612, 0.558, 0.533, 0.495, 0.500, 0.423, 0.395, 0.375, 0.372, 0.391, 0.396, 0.405, 0.428,
    0.429, 0.523, 0.562, 0.607, 0.653, 0.672, 0.708, 0.633, 0.668, 0.645, 0.632, 0.591, 0.559,
    0.597, 0.625, 0.739, 0.710, 0.729, 0.720, 0.636, 0.581, 0.428, 0.292, 0.162, 0.098, 0.054};

struct Model {
  static constexpr std::size_t kParameters = 11;

  std::size_t size() const { return 65; }
  template <class S>
  S residual(std::size_t i, const std::array<S, kParameters>& x) const {
    const double t = static_cast<double>(i) / 10.0;
    S sum = x[0] * exp(-t * x[4]);
    for (std::size_t k = 1; k < 4; ++k) sum = sum + x[k] * exp(-square(t - x[7 + k]) * x[4 + k]);
    return kY[i] - sum;
  }
};

}  // namespace

CertifiedFamily describe_mgh_osborne2() {
  return {.id = "mgh_osborne2",
          .model =
              "y - x1 exp(-t x5) - x2 exp(-(t - x9)^2 x6) - x3 exp(-(t - x10)^2 x7) - x4 exp(-(t - "
              "x11)^2 x8)",
          .source = kMgh,
          .problems = mgh_problems<Model>(
              {.id = "Osborne 2",
               .start = {1.3, 0.65, 0.65, 0.7, 0.6, 3.0, 5.0, 7.0, 2.0, 4.5, 5.5},
               .sum_of_squares = 4.01377e-2})};
}

}  // namespace flexspline::estimators
