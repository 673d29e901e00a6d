#pragma once

#include <vector>

#include <Eigen/Core>

#include "diagnosis/search.hpp"
#include "flexspline/studies/diagnosis.hpp"

namespace flexspline::studies {

/// How far the parameters of a fitted model's causes are known: the covariance of all parameters at
/// once, the baseline's among them, linearised at the fit. Residuals count with their colour, and
/// with their mean square where that is more than noise. Parameters on a bound are held there.
/// Not in it: that another form might do as well.
class CauseSpread {
 public:
  CauseSpread(const Frame& frame, const Findings& findings);

  /// The parameters of a cause of the model, those of value 0 left out, with standard deviations
  /// and normal 95 % intervals, or with the reason why there is none.
  std::vector<CauseParameter> parameters(std::size_t cause) const;

 private:
  /// One parameter of the model that may move: of a cause's shapes or coefficients, or the
  /// baseline's.
  struct Free {
    bool shape = false;
    std::size_t cause = 0;  ///< or the equation, of the baseline's
    Eigen::Index index = 0;
    bool baseline = false;
    double step = 1.0;
  };
  void list_free();
  DriveModel moved(const Free& parameter) const;
  Eigen::VectorXd slope(const Free& parameter) const;
  void solve();
  void attach_spread(bool shape, std::size_t cause, Eigen::Index index,
                     CauseParameter& parameter) const;

  const Frame& frame_;
  const Findings& findings_;
  PerEquation weight_;
  std::vector<Free> free_;
  Eigen::VectorXd std_;  ///< of every free parameter; NaN where the recordings do not tell it
};

}  // namespace flexspline::studies
