#include "diagnosis/frame/jackknife.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>
#include <Eigen/Dense>

namespace flexspline::studies {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

std::vector<Piece> equal_pieces(Index count, Index rows) {
  std::vector<Piece> pieces;
  for (Index k = 0; k < count; ++k) pieces.push_back({k * rows, rows});
  return pieces;
}

VectorXd std_of(const Jackknife& found) { return found.moves.rowwise().norm(); }

VectorXd normal(Index rows, std::uint64_t seed) {
  std::mt19937_64 draw(seed);
  std::normal_distribution<double> unit;
  return VectorXd::NullaryExpr(rows, [&] { return unit(draw); });
}

// Of a mean the jackknife is the standard error of the pieces' means.
TEST(Jackknife, OfAMeanIsTheStandardErrorOfThePiecesMeans) {
  const Index pieces = 7;
  const Index rows = 40;
  const VectorXd y = normal(pieces * rows, 3);
  VectorXd means(pieces);
  for (Index k = 0; k < pieces; ++k) means[k] = y.segment(k * rows, rows).mean();
  const VectorXd left = y.array() - y.mean();
  const Jackknife found = jackknife(MatrixXd::Ones(y.size(), 1), left, equal_pieces(pieces, rows));
  const double n = static_cast<double>(pieces);
  const double expected =
      std::sqrt((means.array() - means.mean()).square().sum() / (n * (n - 1.0)));
  EXPECT_NEAR(std_of(found)[0], expected, 1e-12);
  EXPECT_NEAR(found.quantile, 2.4469, 1e-4) << "Student's of 6";
}

// A model that is linear in its parameters: the same as to fit again without each piece, wherever
// the parameters stand.
TEST(Jackknife, IsToFitAgainWithoutEachPiece) {
  const Index pieces = 5;
  const Index rows = 30;
  MatrixXd J(2 * pieces * rows, 3);
  for (Index k = 0; k < 3; ++k) J.col(k) = normal(J.rows(), 11 + static_cast<std::uint64_t>(k));
  const VectorXd y = normal(J.rows(), 29);
  const auto parts = equal_pieces(pieces, rows);
  const VectorXd best = J.householderQr().solve(y);
  VectorXd sum = VectorXd::Zero(3);
  for (const Piece& piece : parts) {
    MatrixXd rest = J;
    VectorXd left = y;
    for (const Index first : {piece.first, piece.first + pieces * rows}) {
      rest.middleRows(first, piece.count).setZero();
      left.segment(first, piece.count).setZero();
    }
    sum += (rest.householderQr().solve(left) - best).cwiseAbs2();
  }
  const double n = static_cast<double>(pieces);
  const VectorXd expected = (sum * (n - 1.0) / n).cwiseSqrt();
  const VectorXd elsewhere = best + VectorXd::Constant(3, 0.1);
  for (const VectorXd& at : {best, elsewhere}) {
    const Jackknife found = jackknife(J, J * at - y, parts);
    for (Index k = 0; k < 3; ++k) EXPECT_NEAR(std_of(found)[k], expected[k], 1e-10);
  }
}

// 500 sets of ten recordings that are each off by something of their own: Student's intervals
// hold the truth in 95 % of them, where independent rows would do so in a few.
TEST(Jackknife, HoldsTheTruthWhereRecordingsDiffer) {
  const Index pieces = 10;
  const Index rows = 50;
  int held = 0;
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    VectorXd y = 0.3 * normal(pieces * rows, seed);
    const VectorXd own = normal(pieces, 1000 + seed);
    for (Index k = 0; k < pieces; ++k) y.segment(k * rows, rows).array() += own[k];
    const double mean = y.mean();
    const Jackknife found = jackknife(MatrixXd::Ones(y.size(), 1), (y.array() - mean).matrix(),
                                      equal_pieces(pieces, rows));
    held += std::abs(mean) <= found.quantile * std_of(found)[0] ? 1 : 0;
  }
  EXPECT_NEAR(held / 500.0, 0.95, 0.03) << "three standard deviations of 500";
}

TEST(Jackknife, TakesRecordingsForPiecesAndPartsOfFewOnes) {
  Frame frame;
  for (Index k = 0; k < 8; ++k) frame.segments.push_back({"r", 100 * k, 100});
  EXPECT_EQ(pieces_of(frame).size(), 8U);
  frame.segments.resize(2);
  const auto pieces = pieces_of(frame);
  ASSERT_EQ(pieces.size(), 6U);
  Index next = 0;
  for (const Piece& piece : pieces) {
    EXPECT_EQ(piece.first, next);
    next += piece.count;
  }
  EXPECT_EQ(next, 200);
}

}  // namespace
}  // namespace flexspline::studies
