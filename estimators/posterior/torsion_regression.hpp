#pragma once

#include <vector>

#include "posterior/folded_record.hpp"
#include "posterior/rich_spline.hpp"

namespace flexspline::estimators {

struct RichLaws {
  RichSpline f, g_inverse, log_h;
};

/// Columns of the regression: offset (Nm), coefficients of f and g^-1 (Nm), the jump of g^-1 at
/// zero (Nm), coefficients of ln h, inertia and delay in units in which their columns are torques,
/// and the errors of the reconstructed motion in their standard deviations.
struct RegressionColumns {
  Eigen::Index offset = 0, f = 1, g = 0, jump = 0;
  Eigen::Index h = -1;  ///< < 0: h = 1
  Eigen::Index inertia = 0, delay = 0, motion = 0, size = 0;
};

RegressionColumns regression_columns(const RichLaws& laws, const std::vector<FoldedRecord>& records,
                                     bool with_h);

/// Eq. (4) at the rows of a record: J, what J c stands for, Nm, d tau/d phi, Nm/rad, and
/// d tau/d phi', Nm s/rad. J has the columns that all records share and those of the errors of its
/// own motion; those of other records are zero.
struct RegressionRows {
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> jacobian;
  Eigen::VectorXd target;
  Eigen::VectorXd along_motion;
  Eigen::VectorXd along_speed;
  Eigen::Index shared = 0;  ///< columns
  Eigen::Index motion = 0;  ///< where the others begin among the coefficients

  /// The coefficient of a column.
  Eigen::Index coefficient(Eigen::Index column) const {
    return column < shared ? column : motion + column - shared;
  }
  /// Those of all columns, and what they leave of the target, Nm.
  Eigen::VectorXd own(const Eigen::VectorXd& c) const;
  Eigen::VectorXd left(const Eigen::VectorXd& c) const { return target - jacobian * own(c); }
};

/// tau = o + f(phi) + g^-1(phi'/h(phi)) + J phi'' - d d tau/dt + e of all records, linearised in ln
/// h and in the motion at coefficients c; the rest is linear.
class TorsionRegression {
 public:
  TorsionRegression(const RichLaws& laws, const RegressionColumns& at,
                    const std::vector<FoldedRecord>& records);

  /// Of record r.
  RegressionRows linearise(std::size_t r, const Eigen::VectorXd& c) const;

 private:
  /// Where a row lies on the splines over the motion, whatever the coefficients are.
  struct Place {
    RichSpline::Local f, h;
  };
  struct Point;
  Point point(const FoldedRecord& one, std::size_t k, const Place& place,
              const Eigen::VectorXd& c) const;
  void fill_motion(const FoldedRecord& one, std::size_t k, const Point& at,
                   Eigen::Ref<Eigen::RowVectorXd> row) const;

  const RichLaws& laws_;
  const RegressionColumns& at_;
  const std::vector<FoldedRecord>& records_;
  std::vector<std::vector<Place>> places_;  // of every record's rows
  std::vector<Eigen::Index> motion_;        // first column of every record's errors
  // Units of inertia and delay in which their columns are torques.
  double largest_acceleration_ = 0.0;
  double time_scale_ = 0.0;
};

}  // namespace flexspline::estimators
