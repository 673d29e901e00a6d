#include "decision/drive.hpp"

#include <algorithm>
#include <cmath>

#include "decision/splines.hpp"
#include "diagnosis/baseline.hpp"

namespace flexspline::studies::decision {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kElastic = 12;      // intervals of f
constexpr int kDissipative = 20;  // of g^-1, over asinh of the rate
constexpr double kCore = 0.003;   // rate over the largest below which g^-1 is drawn evenly
constexpr double kFastest = 3.0;  // phi'/h over the largest rate
constexpr Index kModulation = 3;  // terms of ln h
constexpr double kModulationStep = 1.0;
constexpr double kZeroStep = 0.3;  // of the torsion range
constexpr double kMountingStep = 0.02;
constexpr double kRateStep = 0.5;  // of ln of the Coulomb rate
constexpr double kMostModulation = 3.0;
constexpr double kDifference = 1e-3;

bool wound(const Frame& frame) { return !frame.travels; }

ArrayXd position(const Frame& seen, const DriveState& state) {
  return seen.torsion / seen.torsion_range - state.nonlinear[kModulation];
}

ArrayXd over_modulation(const Frame& seen, const DriveState& state, const ArrayXd& x) {
  const ArrayXd x2 = x.square();
  const ArrayXd ln_h =
      state.nonlinear[0] * x2 + state.nonlinear[1] * x2.square() + state.nonlinear[2] * x2.cube();
  return seen.torsion_rate / seen.rate_range *
         (-ln_h.max(-kMostModulation).min(kMostModulation)).exp();
}

MatrixXd elastic(const DriveState& state, const ArrayXd& x) {
  return odd_spline(x / state.span, kElastic);
}

// With a prior: one side against the other.
MatrixXd elastic_sides(const DriveState& state, const ArrayXd& x) {
  return even_spline(x / state.span, kElastic);
}

MatrixXd dissipative(const ArrayXd& u) {
  return odd_spline(compressed(u, kCore, kFastest), kDissipative);
}

// f at x and g^-1 at u for the coefficients of the state, where it has been fitted.
ArrayXd elastic_at(const ArrayXd& x, const DriveState& state) {
  const VectorXd& own = state.own[0];
  if (own.size() == 0) return ArrayXd::Zero(x.size());
  const MatrixXd fixed = elastic(state, x);
  ArrayXd f = (fixed * own.head(fixed.cols())).array();
  if (state.random[0].size() > 0) {
    f += (elastic_sides(state, x) * state.random[0]).array();
  }
  return f;
}

ArrayXd dissipative_at(const ArrayXd& u, const DriveState& state, bool offset) {
  const VectorXd& own = state.own[0];
  if (own.size() == 0) return ArrayXd::Zero(u.size());
  const MatrixXd columns = dissipative(u);
  return (columns * own.segment(own.size() - columns.cols() - (offset ? 1 : 0), columns.cols()))
      .array();
}

void add_tangents(const Frame& seen, const DriveState& state, const ArrayXd& x, const ArrayXd& u,
                  BaselineDesign& d) {
  const Index zeros = state.nonlinear.size() - kModulation - 1;
  d.tangents = MatrixXd::Zero(x.size(), state.nonlinear.size());
  d.step = VectorXd::Constant(state.nonlinear.size(), kMountingStep);
  d.step.head(kModulation).setConstant(kModulationStep);
  d.step[kModulation] = kZeroStep;
  if (state.own[0].size() == 0) return;
  const double e = kDifference;
  const bool offset = seen.rig == Rig::specimen;
  const auto g = [&](const ArrayXd& rate) { return dissipative_at(rate, state, offset); };
  const ArrayXd slope_u = (g(u * (1.0 + e)) - g(u * (1.0 - e))) / (2.0 * e);
  ArrayXd power = x.square();
  for (Index k = 0; k < kModulation; ++k) {
    d.tangents.col(k) = -(slope_u * power).matrix();
    power *= x.square();
  }
  const ArrayXd slope = (elastic_at(x + e, state) - elastic_at(x - e, state)) / (2.0 * e);
  const ArrayXd rate =
      (g(over_modulation(seen, state, x + e)) - g(over_modulation(seen, state, x - e))) / (2.0 * e);
  d.tangents.col(kModulation) = -(slope + rate).matrix();
  for (Index i = 0; i < zeros; ++i) {
    const Segment& s = seen.segments[static_cast<std::size_t>(i)];
    d.tangents.col(kModulation + 1 + i).segment(s.first, s.count) =
        -(slope + rate).segment(s.first, s.count).matrix();
  }
}

BaselineDesign gear(const Frame& seen, const DriveState& state, bool tangents) {
  const ArrayXd x = position(seen, state);
  const ArrayXd u = over_modulation(seen, state, x);
  const MatrixXd f = elastic(state, x);
  const MatrixXd g = dissipative(u);
  const bool offset = seen.rig == Rig::specimen;
  BaselineDesign d;
  d.columns.resize(x.size(), f.cols() + g.cols() + (offset ? 1 : 0));
  d.columns.leftCols(f.cols()) = f;
  d.columns.middleCols(f.cols(), g.cols()) = g;
  if (offset) d.columns.rightCols(1).setOnes();
  d.friction = f.cols();
  d.friction_size = g.cols();
  d.random = elastic_sides(state, x);
  d.components.push_back(
      {"torsion", "f on one side against the other", 0, d.random.cols(), true, kMostRatio});
  if (!tangents) return d;
  add_tangents(seen, state, x, u, d);
  // With the zero of every recording its own, one for all is theirs.
  if (state.nonlinear.size() > kModulation + 1) d.tangents.col(kModulation).setZero();
  return d;
}

// Its Coulomb rate is the last of the nonlinear parameters.
BaselineDesign travelling(const Frame& seen, const DriveState& state, bool tangents) {
  const std::vector<double> shape = {state.nonlinear[0]};
  const auto own = baseline_columns(seen, Equation::torsion, shape);
  BaselineDesign d;
  d.columns = own.columns;
  d.friction = own.elastic;
  d.friction_size = own.dissipative;
  d.random.resize(seen.rows(), 0);
  d.tangents = MatrixXd::Zero(seen.rows(), 1);
  d.step = VectorXd::Constant(1, kRateStep);
  if (!tangents || state.own[0].size() == 0) return d;
  const std::vector<double> wider = {state.nonlinear[0] + kDifference};
  const auto next = baseline_columns(seen, Equation::torsion, wider);
  d.tangents.col(0) = (next.columns - own.columns) * state.own[0] / kDifference;
  return d;
}

BaselineDesign shaft(const Frame& seen, Equation equation) {
  const auto own = baseline_columns(seen, equation, {});
  BaselineDesign d;
  d.columns = own.columns;
  d.random.resize(seen.rows(), 0);
  d.tangents.resize(seen.rows(), 0);
  d.friction_size = equation == Equation::motor ? own.elastic + own.dissipative : 1;
  return d;
}

}  // namespace

DriveState first_state(const Frame& frame) {
  DriveState state;
  if (frame.travels) {
    state.nonlinear = VectorXd::Constant(1, std::log(0.02 * frame.rate_range));
    return state;
  }
  const auto zeros = frame.own_zeros ? static_cast<Index>(frame.segments.size()) : 0;
  state.nonlinear = VectorXd::Zero(kModulation + 1 + zeros);
  state.span = 1.1;
  return state;
}

Frame seen_by(const Frame& frame, const DriveState& state) {
  Frame seen = frame;
  if (wound(frame)) {
    for (Index i = kModulation + 1; i < state.nonlinear.size(); ++i) {
      const Segment& s = seen.segments[static_cast<std::size_t>(i - kModulation - 1)];
      seen.torsion.segment(s.first, s.count) -= state.nonlinear[i] * frame.torsion_range;
    }
  }
  for (const Taken& cause : state.causes) {
    if (cause.form->transform != nullptr) cause.form->transform(seen, cause.shape);
  }
  return seen;
}

Frame told(const Frame& frame, Frame seen, Equation equation) {
  if (equation == Equation::motor) seen.torque += frame.smooth_torque - frame.torque;
  return seen;
}

BaselineDesign baseline_design(const Frame& seen, Equation equation, const DriveState& state,
                               bool tangents) {
  if (equation != Equation::torsion) return shaft(seen, equation);
  return wound(seen) ? gear(seen, state, tangents) : travelling(seen, state, tangents);
}

ArrayXd baseline_prediction(const BaselineDesign& design, Equation equation,
                            const DriveState& state) {
  const VectorXd& own = state.own[index_of(equation)];
  if (own.size() == 0) return ArrayXd::Zero(design.columns.rows());
  return (design.columns * own).array();
}

Reference reference_of(const Frame& seen, const DriveState& state) {
  Reference known;
  known.elastic = known.dissipative = ArrayXd::Zero(seen.rows());
  known.motor_sign = rounded_sign(seen.motor_speed, 0.01 * std::max(seen.speed_range, 1e-300));
  const VectorXd& motor = state.own[index_of(Equation::motor)];
  if (motor.size() > 0) {
    const auto own = baseline_columns(seen, Equation::motor, {});
    const ArrayXd dry = (own.columns.middleCols(own.elastic, own.dissipative) *
                         motor.segment(own.elastic, own.dissipative))
                            .array();
    const double largest = dry.abs().maxCoeff();
    if (largest > 0.0) known.motor_sign = dry / largest;
  }
  const bool travels = seen.travels;
  std::vector<double> width = {travels ? state.nonlinear[0] : 0.0};
  known.torsion_coulomb_rate = coulomb_width(seen, width);
  const VectorXd& own = state.own[0];
  if (own.size() > 0 && !travels) {
    const ArrayXd x = position(seen, state);
    known.elastic = elastic_at(x, state);
    known.dissipative =
        dissipative_at(over_modulation(seen, state, x), state, seen.rig == Rig::specimen);
  } else if (own.size() > 0) {
    const auto b = baseline_columns(seen, Equation::torsion, width);
    known.elastic = (b.columns.leftCols(b.elastic) * own.head(b.elastic)).array();
    known.dissipative =
        (b.columns.middleCols(b.elastic, b.dissipative) * own.segment(b.elastic, b.dissipative))
            .array();
  }
  known.friction = known.dissipative;
  for (const Taken& cause : state.causes) {
    if (!cause.form->friction || cause.coefficients.size() == 0) continue;
    const Columns c = cause.form->columns(Equation::torsion, seen, known, cause.shape);
    for (std::size_t k = 0; k < c.size(); ++k) {
      known.friction += cause.coefficients[static_cast<Index>(k)] * c[k];
    }
  }
  return known;
}

}  // namespace flexspline::studies::decision
