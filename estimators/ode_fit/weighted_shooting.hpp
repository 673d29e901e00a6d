#pragma once

#include "ode_fit/shooting_problem.hpp"

namespace flexspline::estimators {

/// Shooting with the layout's whitening and loss over the residuals of the measurements. Segments
/// of one experiment become one block where its noise is coloured; jumps pass through.
class WeightedShooting final : public LeastSquaresProblem {
 public:
  WeightedShooting(const OdeLayout& layout, const ShootingProblem& shots);

  std::size_t blocks() const override { return groups_.size(); }
  std::size_t residuals(std::size_t block) const override;
  Result<void> evaluate(std::size_t block, std::span<const double> q, std::span<double> residual,
                        std::span<double> jacobian) const override;

  /// Half the sum of squares (or what the loss makes of it) of the measurements alone.
  Result<double> data_cost(std::span<const double> q) const;

 private:
  struct Group {
    std::size_t first;
    std::size_t last;
    std::size_t data;
  };
  void whiten(const LaidOutExperiment& experiment, std::span<double> residual,
              std::span<double> jacobian, std::size_t columns) const;
  void apply_loss(std::span<double> residual, std::span<double> jacobian,
                  std::size_t columns) const;

  const OdeLayout& layout_;
  const ShootingProblem& shots_;
  std::vector<Group> groups_;
};

/// Rows of an experiment's residuals that show one output, with their instants.
struct OutputRows {
  std::vector<std::size_t> row;
  std::vector<double> time;
};
OutputRows rows_of(const LaidOutExperiment& experiment, std::size_t output);

}  // namespace flexspline::estimators
