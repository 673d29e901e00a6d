#pragma once

#include <vector>

#include <Eigen/Core>

#include "diagnosis/frame/frame.hpp"

namespace flexspline::studies {

/// Rows of a frame that stand or fall together.
struct Piece {
  Eigen::Index first = 0;
  Eigen::Index count = 0;
};

/// Recordings; where there are few, equal parts of them, so that there are six at least.
std::vector<Piece> pieces_of(const Frame& frame);

struct Jackknife {
  Eigen::MatrixXd moves;  ///< a column a piece, sqrt((P - 1)/P) d_s: moves moves' is the covariance
  double quantile = 0.0;  ///< Student's, 97.5 %, of one freedom less than there are pieces
};

/// The spread of least-squares parameters as pieces of the rows are left out one after the other
/// (Miller 1974; MacKinnon, Nielsen and Webb 2023, CV3), to first order about the minimum:
///   d_s = (J'J - J_s'J_s)^-1 J_s' r_s,  var = (P - 1)/P sum_s d_s^2.
/// What differs between the pieces is in it, whatever its kind: noise of any colour, and errors of
/// the model. Rows of jacobian and residual: those of one equation after another, each a frame's.
/// A direction that one piece alone tells is not counted.
Jackknife jackknife(const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& residual,
                    const std::vector<Piece>& pieces);

}  // namespace flexspline::studies
