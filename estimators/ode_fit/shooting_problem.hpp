#pragma once

#include "ode_fit/layout.hpp"
#include "ode_fit/shot.hpp"
#include "solvers/least_squares.hpp"

namespace flexspline::estimators {

/// What is left of the jumps at nodes.
struct Jumps {
  double largest = 0.0;  ///< in state scales
  double worth = 0.0;    ///< what closing them changes the cost by, to first order
};

/// Residuals of the measurements along trajectories that start at the initial state and, with
/// several segments, at nodes. A node's states are unknowns behind those of the layout; a jump at a
/// node is a residual weight * jump / state_scale + multiplier.
class ShootingProblem final : public LeastSquaresProblem {
 public:
  ShootingProblem(const OdeLayout& layout, double tolerance, int most_segments);

  std::size_t blocks() const override { return segments_.size(); }
  std::size_t residuals(std::size_t block) const override;
  Result<void> evaluate(std::size_t block, std::span<const double> q, std::span<double> residual,
                        std::span<double> jacobian) const override;

  /// Bounds and starts of all unknowns, nodes last and where the measurements are.
  std::vector<BoundedParameter> bounded_parameters() const;
  const LaidOutExperiment& experiment(std::size_t block) const {
    return *segments_[block].experiment;
  }
  /// Residuals of a block that are measurements; those of the jump follow them.
  std::size_t data(std::size_t block) const { return segments_[block].data(); }

  void set_weight(double weight);
  /// Takes the jumps' share into the multipliers.
  Result<Jumps> update_multipliers(std::span<const double> q);

 private:
  struct Segment {
    const LaidOutExperiment* experiment;
    std::size_t first;  ///< measurement
    std::size_t last;
    std::vector<double> times{};
    std::vector<Source> start{};
    std::size_t next = Source::kKnown;  ///< first unknown of the node at its end
    double size = 1.0;                  ///< of residuals, for one state scale
    std::vector<double> multiplier{};

    std::size_t data() const { return experiment->residuals(first, last); }
    std::size_t lead() const { return times.size() - (last - first); }
  };

  void add_segments(const LaidOutExperiment& experiment, int most_segments);
  void fill_data(const Segment& segment, const Shot& shot, std::span<double> residual,
                 std::span<double> jacobian, std::size_t columns) const;
  void fill_jumps(const Segment& segment, const Shot& shot, std::span<const double> q,
                  std::span<double> residual, std::span<double> jacobian) const;
  Result<std::vector<double>> values(const Segment& segment, std::span<const double> q) const;

  const OdeLayout& layout_;
  double tolerance_;
  double weight_ = 1.0;
  std::size_t nodes_ = 0;
  std::vector<Segment> segments_;
};

}  // namespace flexspline::estimators
