#pragma once

#include <array>
#include <vector>

#include "decision/evidence.hpp"
#include "diagnosis/model.hpp"

namespace flexspline::studies::decision {

/// A cause in the model.
struct Taken {
  const CauseRow* row = nullptr;
  const CauseForm* form = nullptr;
  std::vector<double> shape;
  Eigen::VectorXd coefficients;
};

/// Baseline and causes as fitted.
struct DriveState {
  /// Of the torsion law. Wound up: ln h = sum c_k x^2k, k = 1, 2, 3, the zero of x, and where
  /// recordings have zeros of their own, each of them; travelling: ln of the Coulomb rate.
  Eigen::VectorXd nonlinear;
  double span = 1.0;                      ///< the splines of f reach from -span to span of x
  std::array<Eigen::VectorXd, 3> own;     ///< fixed effects of the baseline by equation
  std::array<Eigen::VectorXd, 3> random;  ///< those of its laws with a prior: f's even part
  std::vector<Taken> causes;
};

/// Columns of the baseline in one equation, all rows of the frame.
struct BaselineDesign {
  Eigen::MatrixXd columns;            ///< fixed effects
  Eigen::MatrixXd tangents;           ///< of the nonlinear parameters, at the state
  Eigen::VectorXd step;               ///< prior standard deviation of a step of each
  Eigen::MatrixXd random;             ///< law columns with a prior
  std::vector<Component> components;  ///< of random
  Eigen::Index friction = 0;          ///< columns [friction, friction + friction_size): dissipative
  Eigen::Index friction_size = 0;
};

DriveState first_state(const Frame& frame);

/// The frame as the state's zeros and the causes that change it leave it.
Frame seen_by(const Frame& frame, const DriveState& state);

/// What an equation is told of the frame as seen: at the motor the transmitted torque is a motion's
/// cause and smoothed as motions are, or its noise would be explained by whatever replaces it.
Frame told(const Frame& frame, Frame seen, Equation equation);

/// Fixed effects are lightly penalised by who fits them. tangents: whether they are wanted.
BaselineDesign baseline_design(const Frame& seen, Equation equation, const DriveState& state,
                               bool tangents = true);

/// What the baseline alone predicts of target_of(seen, equation).
Eigen::ArrayXd baseline_prediction(const BaselineDesign& design, Equation equation,
                                   const DriveState& state);

/// The baseline's laws along the rows, for columns of causes.
Reference reference_of(const Frame& seen, const DriveState& state);

}  // namespace flexspline::studies::decision
