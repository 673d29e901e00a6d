#pragma once

#include <memory>

#include "torque_driven/gauss_newton.hpp"
#include "torque_driven/lane_set.hpp"

namespace flexspline::estimators {

/// Largest error of the integration that was found, over the peak of its recording, and whether
/// steps were refined for it.
struct Refinement {
  double error = 0.0;
  bool changed = false;
};

/// How the recordings are integrated, and the recordings packed for it. Learns while it is used.
class IntegrationPlan {
 public:
  IntegrationPlan(const DrivenProblem& problem, std::span<const double> p, InstructionSet set,
                  std::size_t threads);

  /// B'B at p with steps that are stable there: where a step proves too long for the stiffness met
  /// on the way, the recording is taken with more steps, or by the implicit formula, and again.
  const LaneSums& stable_sums(std::span<const double> p);
  /// Compares with solutions of half the steps, and refines recordings that are off by more than
  /// the tolerance.
  Refinement refine(std::span<const double> p, double tolerance);

  /// Motion of every recording at its samples after the first.
  std::vector<std::vector<double>> states(std::span<const double> p);
  std::size_t stiff() const;
  /// Gives the memory of the packed recordings back until they are wanted again.
  void unpack() { set_.reset(); }

 private:
  bool stabilise(const LaneSums& sums);
  LaneSet& packed();

  const DrivenProblem& problem_;
  InstructionSet instructions_;
  std::size_t threads_;
  std::vector<LanePlan> plans_;
  std::unique_ptr<LaneSet> set_;
};

/// The normal equations by the kernels; nothing where g would not rise at zero.
NormalEvaluation evaluation_by(const DrivenProblem& problem, IntegrationPlan& plan);

/// Nothing where a sum is no number.
std::optional<NormalEquations> normal_equations(const DrivenProblem& problem, const LaneSums& sums);

}  // namespace flexspline::estimators
