// Spline bases against quadrature and the identities of B-splines; Spline by its order.
#include <cmath>
#include <numeric>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "flexspline/core/cubic_basis.hpp"
#include "flexspline/core/integrated_basis.hpp"
#include "flexspline/core/spline.hpp"

namespace flexspline {
namespace {

const std::vector<std::vector<double>> kKnotSets = {
    {}, {0.5}, {0.25, 0.5, 0.75}, {0.004, 0.012, 0.035, 0.08, 0.2, 0.4, 0.7}};

std::vector<double> slopes(const IntegratedBasis& basis, double u) {
  std::vector<double> out(basis.size());
  basis.slopes(u, out);
  return out;
}

std::vector<double> values(const IntegratedBasis& basis, double u) {
  std::vector<double> out(basis.size());
  basis.values(u, out);
  return out;
}

TEST(IntegratedBasis, IsTheIntegralOfItsSlopes) {
  for (const auto& knots : kKnotSets) {
    const IntegratedBasis basis(knots);
    ASSERT_EQ(basis.size(), knots.size() + 3);
    for (double u : {0.0, 0.003, 0.3, 0.71, 1.0, 2.5}) {
      // Simpson on many pieces; the slopes are quadratic but for the knots.
      constexpr int kPieces = 20000;
      std::vector<double> integral(basis.size(), 0.0);
      for (int k = 0; k < kPieces; ++k) {
        const auto left = slopes(basis, u * k / kPieces);
        const auto middle = slopes(basis, u * (k + 0.5) / kPieces);
        const auto right = slopes(basis, u * (k + 1.0) / kPieces);
        for (std::size_t i = 0; i < basis.size(); ++i) {
          integral[i] += u / kPieces * (left[i] + 4.0 * middle[i] + right[i]) / 6.0;
        }
      }
      const auto exact = values(basis, u);
      for (std::size_t i = 0; i < basis.size(); ++i) {
        EXPECT_NEAR(exact[i], integral[i], 1e-8) << i << " at " << u;
      }
    }
  }
}

TEST(IntegratedBasis, HasSlopesThatPartUnityAndReproduceTheLine) {
  for (const auto& interior : kKnotSets) {
    const IntegratedBasis basis(interior);
    std::vector<double> knots = {0.0, 0.0, 0.0};
    knots.insert(knots.end(), interior.begin(), interior.end());
    knots.insert(knots.end(), 3, 1.0);
    for (double u = 0.0; u <= 1.0; u += 0.01) {
      double sum = 0.0;
      double line = 0.0;
      const auto b = slopes(basis, u);
      for (std::size_t i = 0; i < b.size(); ++i) {
        EXPECT_GE(b[i], -1e-12);
        sum += b[i];
        line += 0.5 * (knots[i + 1] + knots[i + 2]) * b[i];  // Greville abscissae
      }
      EXPECT_NEAR(sum, 1.0, 1e-12);
      EXPECT_NEAR(line, u, 1e-12);
    }
    const auto tail = values(basis, 4.0);
    EXPECT_NEAR(std::accumulate(tail.begin(), tail.end(), 0.0), 4.0, 1e-12);
  }
}

TEST(IntegratedBasis, WithoutKnotsIsThatOfBernstein) {
  const IntegratedBasis basis({});
  for (double u : {0.0, 0.2, 0.9, 1.0}) {
    const double v = 1.0 - u;
    EXPECT_THAT(slopes(basis, u),
                testing::Pointwise(testing::DoubleNear(1e-14), {v * v, 2.0 * u * v, u * u}));
  }
}

TEST(IntegratedBasis, HasPiecesThatAddUpToItsValues) {
  const IntegratedBasis basis(kKnotSets.back());
  std::vector<double> c(basis.size());
  for (std::size_t i = 0; i < c.size(); ++i) c[i] = 1.0 + static_cast<double>(i * i % 7);
  const auto pieces = basis.pieces(c);
  for (double u : {0.0, 0.004, 0.1, 0.65, 1.0, 1.7}) {
    const std::size_t j = u >= 1.0 ? pieces.size() - 1 : basis.interval(u);
    const double d = u - basis.breakpoints()[j];
    const auto& p = pieces[j];
    const auto each = values(basis, u);
    EXPECT_NEAR(p[0] + d * (p[1] + d * (p[2] + d * p[3])),
                std::inner_product(c.begin(), c.end(), each.begin(), 0.0), 1e-12);
  }
}

TEST(CubicBasis, PartsUnityAndReproducesTheLine) {
  const CubicBasis basis(-2.0, 5.0, 9);
  const double width = 7.0 / 9.0;
  for (double x = -2.4; x <= 5.5; x += 0.07) {
    const auto local = basis.at(x);
    double sum = 0.0;
    double line = 0.0;
    for (std::size_t k = 0; k < 4; ++k) {
      sum += local.value[k];
      line += local.value[k] * (-2.0 + (static_cast<double>(local.first + k) - 1.0) * width);
    }
    EXPECT_NEAR(sum, 1.0, 1e-12);
    EXPECT_NEAR(line, x, 1e-12);
    EXPECT_LT(local.first + 3, basis.size());
  }
}

TEST(CubicBasis, HasTheDerivativesOfItsValues) {
  const CubicBasis basis(0.0, 3.0, 6);
  constexpr double kStep = 1e-5;
  for (double x : {0.1, 0.77, 1.6, 2.9}) {
    const auto at = basis.at(x);
    const auto up = basis.at(x + kStep);
    const auto down = basis.at(x - kStep);
    for (std::size_t k = 0; k < 4; ++k) {
      EXPECT_NEAR(at.slope[k], (up.value[k] - down.value[k]) / (2.0 * kStep), 1e-8);
      EXPECT_NEAR(at.curvature[k], (up.slope[k] - down.slope[k]) / (2.0 * kStep), 1e-8);
    }
  }
}

struct Samples {
  std::vector<double> x;
  std::vector<double> y;
};

template <class Function>
Samples sampled(int count, Function f) {
  Samples s;
  for (int i = 0; i < count; ++i) {
    // Spacing that varies by half along the way, and shrinks with the count.
    const double u = static_cast<double>(i) / (count - 1);
    s.x.push_back(u + 0.08 * std::sin(6.0 * u));
    s.y.push_back(f(s.x.back()));
  }
  return s;
}

double worst_error(int count) {
  const auto f = [](double x) { return std::sin(7.0 * x); };
  const auto s = sampled(count, f);
  const Spline spline(s.x, s.y);
  double worst = 0.0;
  for (double x = s.x.front(); x < s.x.back(); x += 1e-4) {
    worst = std::max(worst, std::abs(spline.value(x) - f(x)));
  }
  return worst;
}

TEST(Spline, ConvergesWithThirdOrderOrBetter) {
  for (int count : {41, 81, 161}) {
    const double order = std::log2(worst_error(count) / worst_error(2 * count - 1));
    EXPECT_GT(order, 2.8);
    EXPECT_LT(order, 4.2);
  }
}

TEST(Spline, ReproducesAParabolaOnUnevenSamples) {
  const auto f = [](double x) { return 3.0 - x + 4.0 * x * x; };
  const auto s = sampled(12, f);
  const Spline spline(s.x, s.y);
  for (double x = s.x.front() + 1e-9; x < s.x.back(); x += 0.003) {
    EXPECT_NEAR(spline.value(x), f(x), 1e-12);
    EXPECT_NEAR(spline.slope(x), 8.0 * x - 1.0, 1e-10);
  }
}

TEST(Spline, IsConstantBeyondItsEnds) {
  const Spline spline(std::vector{1.0, 2.0, 4.0}, std::vector{5.0, 7.0, -3.0});
  EXPECT_EQ(spline.value(-100.0), 5.0);
  EXPECT_EQ(spline.value(100.0), -3.0);
  EXPECT_EQ(spline.slope(-100.0), 0.0);
  EXPECT_EQ(spline.slope(100.0), 0.0);
  EXPECT_NEAR(spline.value(2.0), 7.0, 1e-15);
}

TEST(Spline, DoesNotDependOnTheOrderOfQuestions) {
  const auto s = sampled(50, [](double x) { return std::exp(2.0 * x); });
  const Spline asked(s.x, s.y);
  for (int k = 0; k < 400; ++k) {
    const double x = std::fmod(0.61803398875 * k, 1.0);
    const Spline fresh(s.x, s.y);
    EXPECT_EQ(asked.value(x), fresh.value(x));
    EXPECT_EQ(asked.slope(x), fresh.slope(x));
  }
}

}  // namespace
}  // namespace flexspline
