#include "diagnosis/judged_once.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "diagnosis/held_out_error.hpp"
#include "diagnosis/middle.hpp"
#include "diagnosis/spelled.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

constexpr int kSteps = 8;
constexpr int kPasses = 2;  // the columns of some causes follow the fit

bool is_one_of(const std::vector<std::string>& ids, const std::string& id) {
  return std::ranges::count(ids, id) > 0;
}

const Segment* segment_of(const Frame& frame, const std::string& id) {
  const auto found = std::ranges::find(frame.segments, id, &Segment::id);
  return found == frame.segments.end() ? nullptr : &*found;
}

/// All recordings on one list of rows, those taken away without a say in anything.
struct Joint {
  Frame frame;
  ArrayXd held;  ///< usable rows of the recordings taken away
};

// Where the search moved a recording's zero, it stays moved.
void take_zeros(const Frame& from, Frame& to) {
  if (to.zero != from.zero) {
    to.torsion += to.zero - from.zero;
    to.zero = from.zero;
    if (to.rig == Rig::specimen) to.load_angle = to.motor_angle = to.torsion;
  }
  for (const Segment& s : to.segments) {
    const Segment* known = segment_of(from, s.id);
    if (known == nullptr || !from.own_zeros) continue;
    to.torsion.segment(s.first, s.count) += from.torsion[known->first] - to.torsion[s.first];
  }
  if (from.own_zeros) to.load_angle = to.motor_angle = to.torsion;
}

Result<Joint> joint_of(const RecordingSet& all, const std::vector<std::string>& ids,
                       const Frame& searched, Index most_rows) {
  auto frame = make_frame(all, most_rows);
  if (!frame) return tl::unexpected(frame.error());
  Joint joint{std::move(*frame), {}};
  Frame& f = joint.frame;
  joint.held = ArrayXd::Zero(f.rows());
  for (const Segment& s : f.segments) {
    if (!is_one_of(ids, s.id)) continue;
    joint.held.segment(s.first, s.count) = f.usable.segment(s.first, s.count);
  }
  f.usable *= 1.0 - joint.held;
  f.equations = searched.equations;
  f.firm_spring = searched.firm_spring;
  take_zeros(searched, f);
  f.measure_torsion();
  f.speed_range = searched.speed_range;
  f.torque_range = searched.torque_range;
  return joint;
}

/// Noise levels by the segments of another frame; the middle one where it was not measured.
std::vector<double> levels_on(const Frame& frame, const Frame& searched,
                              const std::vector<double>& level) {
  std::vector<double> list;
  for (const Segment& s : frame.segments) {
    const Segment* known = segment_of(searched, s.id);
    const auto at = static_cast<std::size_t>(known - searched.segments.data());
    list.push_back(known == nullptr ? middle(level) : level[at]);
  }
  return list;
}

Result<ModelFit> fitted_again(const Frame& frame, const Frame& searched, Findings findings) {
  for (Equation equation : frame.equations) {
    const std::size_t e = index_of(equation);
    findings.noise[e].level = levels_on(frame, searched, findings.noise[e].level);
    findings.weight[e] = weights_of(frame, findings.noise[e].level);
    findings.fit_weight[e] = weights_of_fit(frame, findings.weight[e], findings.noise[e].alike);
  }
  for (int pass = 0; pass < kPasses; ++pass) {
    findings.reference = reference_of(frame, findings.fit.model);
    const auto fitted = fit_all(frame, findings, kSteps);
    if (!fitted) return tl::unexpected(fitted.error());
  }
  return findings.fit;
}

Frame judged_frame(const Joint& joint) {
  Frame frame = joint.frame;
  frame.usable = joint.held;
  std::erase_if(frame.segments, [&](const Segment& s) {
    return joint.held.segment(s.first, s.count).sum() == 0.0;
  });
  return frame;
}

}  // namespace

Result<RecordingSet> without(const RecordingSet& set, const std::vector<std::string>& ids) {
  RecordingSet rest = set;
  std::vector<std::string> known;
  for (const Recording& recording : set.recordings) known.push_back(recording.id);
  for (const std::string& id : ids) {
    if (is_one_of(known, id)) continue;
    return failure(ErrorCode::usage, fmt::format("there is no recording '{}' to hold out", id),
                   fmt::format("the set has {}", fmt::join(known, ", ")));
  }
  std::erase_if(rest.recordings, [&](const Recording& r) { return is_one_of(ids, r.id); });
  if (rest.recordings.empty()) {
    return failure(ErrorCode::usage, "every recording is held out", "leave some to find causes in");
  }
  return rest;
}

Result<JudgedOnce> judged_once(const RecordingSet& all, const std::vector<std::string>& ids,
                               const Finding& finding, Index most_rows) {
  const auto& [searched, selection, known] = finding;
  auto joint = joint_of(all, ids, searched, most_rows);
  if (!joint) return tl::unexpected(joint.error());
  const auto before = fitted_again(joint->frame, searched, selection.baseline);
  if (!before) return tl::unexpected(before.error());
  const auto after = fitted_again(joint->frame, searched, selection.final);
  if (!after) return tl::unexpected(after.error());
  const Equation equation = equation_to_prove(searched, selection);
  const std::size_t e = index_of(equation);
  const Frame judged = judged_frame(*joint);
  JudgedOnce once;
  HoldoutProof& p = once.proof;
  p.nested = true;
  p.recordings = ids;
  p.rmse_before = rms_on(before->residual[e], joint->held);
  p.rmse_after = rms_on(after->residual[e], joint->held);
  p.ratio = p.rmse_after / p.rmse_before;
  p.noise_floor = noise_on(judged, noise_levels(judged, after->residual[e]), joint->held);
  resample_ratio(judged, joint->held, before->residual[e], after->residual[e], p);
  once.series = series_of(judged, equation, before->prediction[e], after->prediction[e]);
  for (DiagnosedSeries& series : once.series) series.split = Split::holdout;
  if (equation != Equation::motor) return once;
  for (double* value : {&p.rmse_before, &p.rmse_after, &p.noise_floor}) *value *= searched.ratio;
  return once;
}

}  // namespace flexspline::studies
