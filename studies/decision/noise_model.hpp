#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "diagnosis/frame.hpp"

namespace flexspline::studies::decision {

/// Rows of an equation that count, with how many of its own recording stand before each without a
/// break.
struct Rows {
  std::vector<Eigen::Index> row;     ///< of the frame
  std::vector<Eigen::Index> behind;  ///< rows before it in its unbroken run
  std::vector<std::size_t> segment;  ///< its recording

  Eigen::Index size() const { return static_cast<Eigen::Index>(row.size()); }
};

/// Rows with usable > 0.
Rows rows_of(const Frame& frame, const Eigen::ArrayXd& usable);

/// Noise of an equation, v_i = sum_k a_k v_{i-k} + s_r w_i e_i: an autoregression of the recordings
/// together, its scale s_r by recording, e of a Student t. A white part and quantisation make the
/// order longer; they are not told apart. The first rows of a run are predicted by the best
/// predictors of lower order.
struct NoiseModel {
  std::vector<std::vector<double>> predictor;  ///< a of order 0, 1, ... p
  std::vector<double> innovation;              ///< their standard deviation over that of order p
  std::vector<double> scale;                   ///< s_r, Nm
  Eigen::ArrayXd weight;                       ///< 1/w_i by row; 1 where the noise is normal
  double freedom = 0.0;                        ///< of the t; 0: normal

  int order() const { return static_cast<int>(predictor.size()) - 1; }
  /// Long-run variance over variance.
  double inefficiency() const;
};

/// White, of these standard deviations by recording.
NoiseModel white_noise(const Rows& rows, std::vector<double> scale);

/// The innovations of every column over their standard deviation, row by row.
Eigen::MatrixXd whitened(const NoiseModel& noise, const Rows& rows, const Eigen::MatrixXd& columns);

/// ln |d whitened / d raw|.
double log_jacobian(const NoiseModel& noise, const Rows& rows);

/// Order by the Bayesian information criterion among those whose memory is shorter than
/// longest_rows, coefficients by Levinson and Durbin, scale by recording (shrunk to the common one
/// by fifty rows), freedom by likelihood. residual: of the rows.
NoiseModel fit_noise(const Rows& rows, std::size_t recordings, const Eigen::VectorXd& residual,
                     double longest_rows);

}  // namespace flexspline::studies::decision
