#pragma once

#include <vector>

#include <Eigen/Core>

namespace flexspline::studies {

/// A coordinate of a table: its value in every row, and the knots between which the table is
/// linear. Beyond the first and the last knot it is held.
struct TableKnots {
  Eigen::ArrayXd x;
  std::vector<double> knots;  ///< rising
};

/// Knots at even quantiles of x over the rows with a weight, at most that many, none twice.
std::vector<double> quantile_knots(const Eigen::ArrayXd& x, const Eigen::ArrayXd& weight,
                                   int count);

/// A function of one or two coordinates, piecewise (bi)linear between its knots.
class SmoothTable {
 public:
  /// One or two axes.
  explicit SmoothTable(std::vector<TableKnots> axes);

  /// z(x) u in every row; u: values at the knots, the last axis fastest.
  Eigen::ArrayXd at_rows(const Eigen::VectorXd& u) const;

  /// Values at the knots by Bayesian regression of y, rows weighted by 1 / standard deviation and
  /// counted over the noise's colour: u ~ N(0, s^2), both variances by MacKay's fixed point (1992).
  struct Fit {
    Eigen::VectorXd u;
    double gain = 0.0;  ///< log evidence over that of u = 0, nats
  };
  Fit fit(const Eigen::ArrayXd& y, const Eigen::ArrayXd& weight, double colour) const;

  /// Share of the rows' weight at every knot.
  Eigen::VectorXd occupation(const Eigen::ArrayXd& weight) const;

  const std::vector<TableKnots>& axes() const { return axes_; }
  Eigen::Index size() const { return size_; }

 private:
  /// Knots that a row lies between, and their shares.
  struct Local {
    Eigen::Index first[2] = {0, 0};
    double upper[2] = {0.0, 0.0};
  };

  template <class Visit>
  void visit(Eigen::Index row, const Visit& visit) const;

  std::vector<TableKnots> axes_;
  std::vector<Local> rows_;
  Eigen::Index size_ = 0;
};

}  // namespace flexspline::studies
