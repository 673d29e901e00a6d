#include "diagnosis/search/zeros.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

constexpr int kPasses = 10;
constexpr int kFitSteps = 4;
constexpr double kNudge = 1e-4;    // of the torsion range
constexpr double kLargest = 0.05;  // step, of the same
constexpr double kSettled = 2e-4;  // the same, of the last one

void move(Frame& frame, const ArrayXd& by) {
  for (std::size_t i = 0; i < frame.segments.size(); ++i) {
    Segment& s = frame.segments[i];
    frame.torsion.segment(s.first, s.count) += by[static_cast<Index>(i)];
    s.zero -= by[static_cast<Index>(i)];
  }
  frame.load_angle = frame.motor_angle = frame.torsion;
}

// By how much every recording's torsion is short, to first order.
ArrayXd steps(const Frame& frame, const Findings& findings) {
  const auto count = static_cast<Index>(frame.segments.size());
  const double nudge = kNudge * frame.torsion_range;
  Frame nudged = frame;
  move(nudged, ArrayXd::Constant(count, nudge));
  const std::size_t e = index_of(Equation::torsion);
  const DriveModel& model = findings.fit.model;
  const ArrayXd now = evaluate(frame, model, findings.reference).residual[e];
  const ArrayXd then = evaluate(nudged, model, findings.reference).residual[e];
  const ArrayXd slope = (then - now) / nudge * findings.weight[e];
  const ArrayXd target = now * findings.weight[e];
  ArrayXd by(count);
  for (Index i = 0; i < count; ++i) {
    const Segment& s = frame.segments[static_cast<std::size_t>(i)];
    const auto j = slope.segment(s.first, s.count);
    const double curvature = j.square().sum();
    by[i] = curvature > 0.0 ? -(j * target.segment(s.first, s.count)).sum() / curvature : 0.0;
  }
  const double most = kLargest * frame.torsion_range;
  return by.max(-most).min(most);
}

}  // namespace

Result<Frame> with_fitted_zeros(Frame frame, Findings findings) {
  for (int pass = 0; pass < kPasses; ++pass) {
    const ArrayXd by = steps(frame, findings);
    move(frame, by);
    frame.measure_torsion();
    findings.reference = reference_of(frame, findings.fit.model);
    const auto fitted = fit_all(frame, findings, kFitSteps);
    if (!fitted) return tl::unexpected(fitted.error());
    if (by.abs().maxCoeff() < kSettled * frame.torsion_range) break;
  }
  return frame;
}

}  // namespace flexspline::studies
