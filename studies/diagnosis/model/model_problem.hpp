#pragma once

#include <span>
#include <vector>

#include "diagnosis/model/model_columns.hpp"
#include "flexspline/estimators/separable.hpp"

namespace flexspline::studies {

/// Shapes of a cause on these recordings.
std::vector<Shape> shapes_of(const ActiveCause& cause, const Frame& frame);

/// A shape as it is searched, in the logarithm where it says so, and back.
double inner(const Shape& shape, double value);
double outer(const Shape& shape, double value);

/// The range of a shape as it is searched, from a value of its own; one that is tried and not
/// refined is held.
estimators::ShapeBound bound_of(const Shape& shape, double value);

/// Some equations of a model as a separable problem in shapes q (the baseline's, then those of each
/// cause) and linear parameters b (the baseline's by equation, then those of each cause).
class ModelProblem {
 public:
  ModelProblem(ModelColumns& columns, const Frame& frame, const PerEquation& weight,
               const std::vector<Equation>& equations, const DriveModel& start);

  const std::vector<estimators::ShapeBound>& shapes() const { return shapes_; }
  const Eigen::VectorXd& lower() const { return lower_; }
  std::vector<estimators::SeparableBlock> assemble(std::span<const double> q) const;
  /// What assemble() leaves of the target with linear parameters b, by equation.
  std::vector<Eigen::VectorXd> residuals(std::span<const double> q, const Eigen::VectorXd& b) const;
  /// By how much a step of a shape changes the residual of a fit, by equation; empty of one that it
  /// does not act on.
  std::vector<Eigen::VectorXd> changes(const estimators::SeparableFit& fit, std::size_t shape,
                                       double step) const;
  /// The model with these shapes.
  DriveModel at(std::span<const double> q) const;
  /// b of a model; 0 of what it does not have.
  Eigen::VectorXd coefficients_of(const DriveModel& model) const;
  void put_coefficients(const Eigen::VectorXd& b, DriveModel& model) const;

 private:
  /// Where linear parameters stand in b.
  struct Place {
    Eigen::Index at = 0;
    Eigen::Index size = 0;
  };

  bool fits(Equation equation) const;
  void lay_out_shapes();
  void lay_out_linear();
  estimators::SeparableBlock block_of(const DriveModel& model, std::size_t e) const;
  Eigen::VectorXd residual_of(const DriveModel& model, std::size_t e) const;
  DriveModel fitted(std::span<const double> q, const Eigen::VectorXd& b) const;
  void change_baseline(const DriveModel& from, const DriveModel& to,
                       std::vector<Eigen::VectorXd>& changes) const;
  void change_cause(const DriveModel& from, const DriveModel& to, std::size_t cause,
                    std::vector<Eigen::VectorXd>& changes) const;

  ModelColumns& columns_;
  const Frame& frame_;
  const std::vector<Equation> equations_;
  const DriveModel& start_;
  std::vector<WeightedRows> rows_;
  std::vector<std::vector<Shape>> cause_shapes_;
  std::vector<estimators::ShapeBound> shapes_;
  std::vector<std::size_t> cause_of_;  ///< by shape, behind those of the baseline
  std::vector<Place> own_, causes_;
  Eigen::VectorXd lower_;
};

}  // namespace flexspline::studies
