#pragma once

#include "torque_driven/driven_nlp.hpp"
#include "torque_driven/integration_plan.hpp"

namespace flexspline::estimators {

/// The points of all recordings at which collocation obeys the law: the samples, and more of them
/// where those are too far apart.
class CollocationMesh {
 public:
  using Series = std::vector<std::vector<double>>;  ///< motions at the samples after the first

  explicit CollocationMesh(const DrivenProblem& problem);

  const std::vector<DrivenMesh>& meshes() const { return meshes_; }
  /// Variables of the NLP: coefficients and motions, between samples on straight lines.
  std::vector<double> packed(std::span<const double> p, const Series& states) const;
  /// Variables that would obey the law on this mesh at p, to first order from the states of an
  /// integrator. For meshes without points between samples.
  std::vector<double> foreseen(std::span<const double> p, const Series& states) const;
  /// Divides what does not follow the states; the error of an interval is of order 4 in its width.
  Refinement divide(std::span<const double> x, const Series& states, double tolerance);

 private:
  void build();

  const DrivenProblem& problem_;
  std::vector<std::vector<std::size_t>> parts_;  // of each interval
  std::vector<DrivenMesh> meshes_;
};

}  // namespace flexspline::estimators
