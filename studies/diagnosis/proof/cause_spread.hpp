#pragma once

#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "diagnosis/frame/jackknife.hpp"
#include "diagnosis/search/search.hpp"
#include "flexspline/studies/diagnosis.hpp"

namespace flexspline::studies {

/// Standard deviation, and half of a 95 % interval; NaN where the recordings do not tell.
struct Spread {
  double std = kNotComputed;
  double half = kNotComputed;
};

/// How far the parameters of a fitted model's causes are known: all parameters at once, the
/// baseline's among them, linearised at the fit; the larger of two. The covariance, with residuals
/// counted by their colour, and by their mean square where that is more than noise: what noise
/// alone would do. The jackknife over recordings: what differs between them, zeros, temperatures
/// and errors of a form, is in it. Parameters on a bound are held there.
/// Not in it: what is wrong in all recordings alike, and that another form might do as well.
class CauseSpread {
 public:
  CauseSpread(const Frame& frame, const Findings& findings);

  /// The parameters of a cause of the model, those of value 0 left out, with standard deviations
  /// and 95 % intervals within their bounds, or with the reason why there is none.
  std::vector<CauseParameter> parameters(std::size_t cause) const;

  /// The same of a cause's size, which goes with its own parameters.
  Spread size(std::size_t cause, const std::function<double(const DriveModel&)>& size_in) const;

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
  Eigen::VectorXd weighted_residual() const;
  void solve();
  /// Of a quantity that goes with the free parameters by these slopes.
  Spread spread_of(const Eigen::VectorXd& slopes) const;
  /// Where it may be.
  std::pair<double, double> bounds_of(const Free& parameter) const;
  /// Which free parameter it is; none: it is held.
  std::optional<std::size_t> find(bool shape, std::size_t cause, Eigen::Index index) const;
  /// at: the free parameter within whose bounds it stays; slopes: of the parameter by the free
  /// ones.
  void attach_spread(std::optional<std::size_t> at, const Eigen::VectorXd& slopes,
                     CauseParameter& parameter) const;
  /// Coefficients of a cause as the catalogue means them, and how they go with the free parameters.
  struct Catalogued {
    Eigen::VectorXd value;
    Eigen::MatrixXd slopes;  ///< free parameters by coefficients
  };
  Catalogued catalogued(std::size_t cause) const;

  const Frame& frame_;
  const Findings& findings_;
  PerEquation weight_;
  std::vector<Free> free_;
  std::vector<bool> told_;    ///< of every free parameter, whether the recordings tell it
  Eigen::MatrixXd by_noise_;  ///< a square root of the covariance that noise alone would give
  Jackknife apart_;
};

}  // namespace flexspline::studies
