#include "decision/predict.hpp"

#include <algorithm>
#include <cmath>

#include "diagnosis/baseline.hpp"

namespace flexspline::studies::decision {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

constexpr int kZeroPasses = 8;
constexpr double kNudge = 1e-4;  // of the torsion range
constexpr double kMostStep = 0.05;

ArrayXd residual(const Frame& frame, const DriveState& state, Equation equation) {
  const Frame all = seen_by(frame, state);
  const Frame seen = told(frame, all, equation);
  const BaselineDesign design = baseline_design(seen, equation, state, false);
  ArrayXd r = target_of(seen, equation) - baseline_prediction(design, equation, state);
  if (equation == Equation::torsion && state.random[0].size() > 0) {
    r -= (design.random * state.random[0]).array();
  }
  const Reference known = reference_of(all, state);
  for (const Taken& cause : state.causes) {
    if (cause.form->columns == nullptr || cause.coefficients.size() == 0) continue;
    if (std::ranges::count(cause.form->at, equation) == 0) continue;
    const Columns columns = cause.form->columns(equation, seen, known, cause.shape);
    for (std::size_t k = 0; k < columns.size(); ++k) {
      r -= cause.coefficients[static_cast<Index>(k)] * seen.recorded(columns[k]);
    }
  }
  return r;
}

// The zeros of the frame's recordings: those of the state by id, others by the data.
DriveState with_zeros(const Frame& frame, const Frame& fitted, const DriveState& state) {
  if (state.nonlinear.size() <= 4 || frame.travels) return state;
  DriveState own = state;
  const auto n = static_cast<Index>(frame.segments.size());
  own.nonlinear.conservativeResize(4 + n);
  std::vector<Index> open;
  for (Index i = 0; i < n; ++i) {
    const auto& id = frame.segments[static_cast<std::size_t>(i)].id;
    const auto found = std::ranges::find(fitted.segments, id, &Segment::id);
    own.nonlinear[4 + i] = 0.0;
    if (found == fitted.segments.end()) open.push_back(i);
    if (found != fitted.segments.end())
      own.nonlinear[4 + i] = state.nonlinear[4 + (found - fitted.segments.begin())];
  }
  for (int pass = 0; pass < kZeroPasses && !open.empty(); ++pass) {
    DriveState nudged = own;
    for (const Index i : open) nudged.nonlinear[4 + i] += kNudge;
    const ArrayXd now = residual(frame, own, Equation::torsion);
    const ArrayXd slope = (residual(frame, nudged, Equation::torsion) - now) / kNudge;
    for (const Index i : open) {
      const Segment& s = frame.segments[static_cast<std::size_t>(i)];
      const auto ok = frame.usable.segment(s.first, s.count);
      const double square = (ok * slope.segment(s.first, s.count).square()).sum();
      const double product =
          (ok * slope.segment(s.first, s.count) * now.segment(s.first, s.count)).sum();
      if (square > 0.0) own.nonlinear[4 + i] -= std::clamp(product / square, -kMostStep, kMostStep);
    }
  }
  return own;
}

}  // namespace

Frame to_scale_of(Frame frame, const Frame& fitted) {
  frame.torsion_range = fitted.torsion_range;
  frame.rate_range = fitted.rate_range;
  frame.slow_rate = fitted.slow_rate;
  frame.speed_range = fitted.speed_range;
  frame.torque_range = fitted.torque_range;
  frame.duration = fitted.duration;
  frame.interval = fitted.interval;
  frame.session = fitted.session;
  for (const Segment& s : fitted.segments) {
    const auto same = std::ranges::find(frame.segments, s.id, &Segment::id);
    if (same == frame.segments.end()) continue;
    frame.clock += fitted.clock[s.first] - frame.clock[same->first];
    break;
  }
  return frame;
}

ArrayXd predicted(const Frame& frame, const Frame& fitted, const DriveState& state,
                  Equation equation) {
  const Frame scaled = to_scale_of(frame, fitted);
  const DriveState own = with_zeros(scaled, fitted, state);
  const ArrayXd& measured = equation == Equation::motor ? scaled.motor_torque : scaled.torque;
  return measured - residual(scaled, own, equation);
}

}  // namespace flexspline::studies::decision
