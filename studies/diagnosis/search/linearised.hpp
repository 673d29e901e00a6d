#pragma once

#include <memory>
#include <vector>

#include "diagnosis/model/model_problem.hpp"
#include "diagnosis/search/search.hpp"

namespace flexspline::studies {

/// Some equations of the findings' model, to first order in all its parameters about their fit, in
/// which one more cause is fitted exactly: y - X b0 = [X dy/dq] d + C(s) a, with the columns on the
/// left built once for all causes. What the baseline takes of a cause is accounted for, as far as
/// a first order goes. Bounds from below hold, of shapes too; those from above do not.
class Linearised {
 public:
  Linearised(const Frame& frame, const Findings& findings, std::vector<Equation> equations);

  struct Fit {
    std::vector<double> shape;
    double gain = 0.0;  ///< fall of the chi square
  };

  /// A cause with its shapes refined from where it has them by at most that many steps.
  /// Thread-safe. Errors: numerics, columns with values out of range.
  Result<Fit> with(const ActiveCause& cause, int steps) const;

 private:
  struct Block {
    WeightedRows rows;
    std::shared_ptr<const estimators::SharedColumns> columns;
    Eigen::VectorXd residual;
    std::vector<Eigen::Index> index;
  };
  class Candidate;

  void take(const ModelProblem& model, const Eigen::VectorXd& b);
  double chi_square(const std::vector<Eigen::VectorXd>& residual) const;

  const Frame& frame_;
  const Findings& findings_;
  std::vector<Equation> equations_;
  std::vector<Block> blocks_;
  Eigen::VectorXd lower_;  ///< of d
  double chi_square_ = 0.0;
};

}  // namespace flexspline::studies
