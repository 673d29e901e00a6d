#include "diagnosis/frame/jackknife.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

#include <boost/math/distributions/students_t.hpp>

namespace flexspline::studies {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index kLeastPieces = 6;
constexpr double kUntold = 1e-8;  // eigenvalue of a correlation that says nothing

VectorXd solved(const MatrixXd& normal, const VectorXd& right) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(normal);
  const VectorXd inverse =
      (eigen.eigenvalues().array() > kUntold).select(eigen.eigenvalues().array().inverse(), 0.0);
  return eigen.eigenvectors() * inverse.cwiseProduct(eigen.eigenvectors().transpose() * right);
}

/// J_s'J_s and J_s'r_s.
struct Share {
  MatrixXd normal;
  VectorXd gradient;
};

Share share_of(const MatrixXd& jacobian, const VectorXd& residual, const Piece& piece, Index rows) {
  Share share{MatrixXd::Zero(jacobian.cols(), jacobian.cols()), VectorXd::Zero(jacobian.cols())};
  for (Index first = piece.first; first < jacobian.rows(); first += rows) {
    const auto J = jacobian.middleRows(first, piece.count);
    share.normal += J.transpose() * J;
    share.gradient += J.transpose() * residual.segment(first, piece.count);
  }
  return share;
}

}  // namespace

std::vector<Piece> pieces_of(const Frame& frame) {
  const auto recordings = static_cast<Index>(frame.segments.size());
  const Index parts = (kLeastPieces + recordings - 1) / recordings;
  std::vector<Piece> pieces;
  for (const Segment& s : frame.segments) {
    for (Index k = 0; k < parts; ++k) {
      const Index first = s.first + s.count * k / parts;
      pieces.push_back({first, s.first + s.count * (k + 1) / parts - first});
    }
  }
  return pieces;
}

Jackknife jackknife(const MatrixXd& jacobian, const VectorXd& residual,
                    const std::vector<Piece>& pieces) {
  Index rows = 0;
  for (const Piece& piece : pieces) rows = std::max(rows, piece.first + piece.count);
  std::vector<Share> shares;
  Share all{MatrixXd::Zero(jacobian.cols(), jacobian.cols()), VectorXd::Zero(jacobian.cols())};
  for (const Piece& piece : pieces) {
    shares.push_back(share_of(jacobian, residual, piece, rows));
    all.normal += shares.back().normal;
    all.gradient += shares.back().gradient;
  }
  // A fit that has ended is near its minimum: the gradients are taken there.
  const VectorXd to_minimum = solved(all.normal, all.gradient);
  const auto count = static_cast<double>(pieces.size());
  Jackknife found{MatrixXd(jacobian.cols(), std::ssize(pieces)),
                  boost::math::quantile(boost::math::students_t(count - 1.0), 0.975)};
  Index next = 0;
  for (const Share& s : shares) {
    found.moves.col(next++) = std::sqrt((count - 1.0) / count) *
                              solved(all.normal - s.normal, s.gradient - s.normal * to_minimum);
  }
  return found;
}

}  // namespace flexspline::studies
