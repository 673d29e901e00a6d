#pragma once

#include "solvers/ipopt_nlp.hpp"
#include "torque_driven/driven_second.hpp"

namespace flexspline::estimators {

/// Points of one recording at which the law is obeyed.
struct DrivenMesh {
  std::vector<double> time;
  std::vector<double> torque;
  std::vector<std::size_t> sample;  ///< the point of each sample

  std::size_t points() const { return time.size(); }
};

/// Interval n between two samples in parts[n] equal parts.
DrivenMesh driven_mesh(const DrivenSeries& series, std::span<const std::size_t> parts);

/// Coefficients of the derivative at one of some points of the polynomial through all.
std::vector<double> derivative_weights(std::span<const double> points, double at);

/// Half the sum of squares over the coefficients and the motions at all points but the first, whose
/// motion is known. The derivative at a point of the polynomial through it and its predecessors
/// (near the start: through the first points) obeys the law there: backward differentiation, which
/// needs the law at the points alone. So the Lagrangian's Hessian has the coefficients' rows and a
/// diagonal. Coefficients come first; constraint k belongs to motion k.
class DrivenNlp final : public SparseNlp {
 public:
  static constexpr std::size_t kStencil = 5;

  DrivenNlp(const DrivenProblem& problem, const std::vector<DrivenMesh>& meshes);

  std::size_t variables() const override { return parameters_ + points_.size(); }
  std::size_t constraints() const override { return points_.size(); }
  void bounds(std::span<double> lower, std::span<double> upper) const override;
  SparsePattern jacobian_pattern() const override;
  SparsePattern hessian_pattern() const override;
  bool objective(std::span<const double> x, double& f) const override;
  bool gradient(std::span<const double> x, std::span<double> g) const override;
  bool constraint(std::span<const double> x, std::span<double> c) const override;
  bool jacobian(std::span<const double> x, std::span<double> values) const override;
  bool hessian(std::span<const double> x, double factor, std::span<const double> lambda,
               std::span<double> values) const override;

 private:
  struct Point {
    double width = 0.0;  ///< to the point before
    double torque = 0.0;
    double measured = 0.0;
    double weight = 0.0;    ///< 0 between samples
    double known = 0.0;     ///< what the known first motion adds to the derivative
    std::size_t first = 0;  ///< of the stencil, among the motions
    std::size_t count = 0;
    std::size_t weights = 0;  ///< in weights_
  };

  void add(const DrivenSeries& series, const DrivenMesh& mesh);
  void differentiate_at(std::span<const double> x, const Point& point, std::size_t k,
                        Derivatives order) const;

  const DrivenProblem& problem_;
  std::size_t parameters_;
  std::vector<Point> points_;
  std::vector<double> weights_;  ///< times the width; points with like neighbours share them
  mutable DrivenDerivatives law_;
};

}  // namespace flexspline::estimators
