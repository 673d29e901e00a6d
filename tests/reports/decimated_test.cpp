// What is left of a curve that is drawn from fewer points.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "decimated.hpp"

namespace flexspline::reports {
namespace {

using Series = std::vector<double>;

/// Largest distance of a curve's points from the polygon that is drawn, in extents of 1.
double gap(const Series& x, const Series& y, const Series& u, const Series& v) {
  double worst = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    double nearest = 1e300;
    for (std::size_t k = 0; k + 1 < u.size(); ++k) {
      const double dx = u[k + 1] - u[k];
      const double dy = v[k + 1] - v[k];
      const double along = ((x[i] - u[k]) * dx + (y[i] - v[k]) * dy) / (dx * dx + dy * dy);
      const double share = std::min(1.0, std::max(0.0, along));
      nearest = std::min(nearest, std::hypot(x[i] - u[k] - share * dx, y[i] - v[k] - share * dy));
    }
    worst = std::max(worst, nearest);
  }
  return worst;
}

TEST(Decimated, ARampKeepsItsCornersAlone) {
  Series x, y;
  for (int i = 0; i <= 9000; ++i) {
    x.push_back(i);
    y.push_back(i < 3000 ? i : i < 6000 ? 3000 : 9000 - i);
  }
  decimate(x, y, 400);
  EXPECT_EQ(x, (Series{0, 3000, 6000, 9000}));
  EXPECT_EQ(y, (Series{0, 3000, 3000, 0}));
}

TEST(Decimated, ALoopMovesByLessThanAThousandth) {
  Series x, y;
  for (int i = 0; i <= 20000; ++i) {
    const double t = 2.0 * std::numbers::pi * i / 20000.0;
    x.push_back(0.5 * std::sin(t));
    y.push_back(0.5 * std::sin(t + 0.3 * std::tanh(8.0 * std::cos(t))));
  }
  Series u = x, v = y;
  decimate(u, v, 2000);
  EXPECT_LT(u.size(), 300u);
  EXPECT_LT(gap(x, y, u, v), 1.01e-3);
}

TEST(Decimated, NoiseIsHeldToTheMostPointsAndKeepsItsExtremes) {
  Series x, y;
  for (int i = 0; i < 50000; ++i) {
    x.push_back(i);
    y.push_back(std::sin(12.9898 * i) * std::cos(78.233 * i));
  }
  const double top = *std::max_element(y.begin(), y.end());
  decimate(x, y, 1000);
  EXPECT_LE(x.size(), 1000u);
  EXPECT_EQ(x.front(), 0.0);
  EXPECT_EQ(x.back(), 49999.0);
  EXPECT_NEAR(*std::max_element(y.begin(), y.end()), top, 0.6);
}

TEST(Decimated, ALineBreaksWhereItIsNoNumberAndNowhereElse) {
  Series x, y;
  for (int i = 0; i <= 9000; ++i) {
    x.push_back(i);
    y.push_back(i > 4000 && i < 5000 ? std::nan("") : i);
  }
  decimate(x, y, 400);
  EXPECT_EQ(x, (Series{0, 4000, 4001, 5000, 9000}));
  EXPECT_TRUE(std::isnan(y[2]));
  y[2] = 0.0;
  EXPECT_EQ(y, (Series{0, 4000, 0, 5000, 9000}));
}

TEST(Decimated, CurvesThatShareTheirPointsKeepThoseThatAnyNeeds) {
  Series x, straight, bent;
  for (int i = 0; i <= 1000; ++i) {
    x.push_back(i);
    straight.push_back(2.0 * i);
    bent.push_back(i == 500 ? 300.0 : 0.0);
  }
  const DrawnCurve curves[] = {{&x, &straight}, {&x, &bent}};
  keep_points(straight, seen_points(curves, 100));
  EXPECT_EQ(straight, (Series{0, 998, 1000, 1002, 2000}));
}

}  // namespace
}  // namespace flexspline::reports
