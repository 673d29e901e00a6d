#pragma once

#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace flexspline::studies::decision {

/// Columns of a hundredth of the largest torque have at most a fifth of it; with more the inner
/// products lose their digits.
inline constexpr double kMostRatio = 400.0;

/// Columns [first, first + size) of Z that share a variance: u ~ N(0, s^2 I).
struct Component {
  std::string coordinate;  ///< of flexspline-diagnosis/1
  std::string says;        ///< what it is a function of
  Eigen::Index first = 0;
  Eigen::Index size = 0;
  bool nuisance = false;     ///< a part of the baseline: how a bench differs from its laws
  double most = kMostRatio;  ///< variance over noise that it may have
};

/// One equation, whitened and with the baseline projected out, by its inner products alone:
/// y = W c + Z u + e, e ~ N(0, s^2 I). Every model of columns of W needs no more of the rows.
struct Gram {
  Eigen::MatrixXd zz, zw, ww;
  Eigen::VectorXd zy, wy;
  double yy = 0.0;
  double contrasts = 0.0;     ///< rows less the baseline's columns
  double log_jacobian = 0.0;  ///< of the whitening
};

/// Appends columns of W by their inner products with Z, the W before them, themselves and y.
void append(Gram& gram, const Eigen::MatrixXd& z_new, const Eigen::MatrixXd& w_new,
            const Eigen::MatrixXd& new_new, const Eigen::VectorXd& new_y);

/// Z integrated out for given variance ratios d_k = s_k^2/s^2: inner products of [W y] in the
/// metric (I + Z D Z')^-1, by M = I + D^1/2 Z'Z D^1/2 = L L'.
struct Reduced {
  Eigen::MatrixXd s;            ///< of [W y]
  double log_det = 0.0;         ///< ln det M, halved
  Eigen::MatrixXd lower;        ///< L
  Eigen::MatrixXd t;            ///< L^-1 D^1/2 Z'[W y]
  Eigen::VectorXd root;         ///< D^1/2 of the columns that stay
  std::vector<Eigen::Index> z;  ///< which they are
};
Reduced reduce(const Gram& gram, std::span<const Component> components,
               const Eigen::VectorXd& ratio);

/// The same with the columns that were appended to the Gram matrix since: a rank update.
void extend(Reduced& reduced, const Gram& gram);

/// Which columns of W a model has: free ones, those that are not negative, and one that stands with
/// coefficient 1.
struct FixedEffects {
  std::vector<Eigen::Index> free;
  std::vector<bool> nonnegative;  ///< beside free
  Eigen::Index whole = -1;        ///< -1: none
};

/// c by generalised least squares, s^2 of every equation by its own residual.
struct Solution {
  double log_likelihood = 0.0;  ///< marginal over u, restricted over the baseline
  Eigen::VectorXd c;            ///< of the free columns
  Eigen::MatrixXd covariance;
  Eigen::VectorXd noise;  ///< s^2 by equation
  int active = 0;         ///< coefficients that are not on their bound
};
Solution solve(std::span<const Gram> grams, std::span<const Reduced> reduced,
               const FixedEffects& columns);

/// Variance ratios by the fixed point of MacKay (1992), which is that of REML, from a start.
struct VarianceFit {
  Solution solution;
  std::vector<Eigen::VectorXd> ratio;  ///< by equation and component
  std::vector<Eigen::VectorXd> u;      ///< predictor of the random effects, all columns of Z
};
VarianceFit fit_variances(std::span<const Gram> grams,
                          std::span<const std::vector<Component>> components,
                          const FixedEffects& columns, std::vector<Eigen::VectorXd> ratio,
                          int iterations);

}  // namespace flexspline::studies::decision
