#include "diagnosis/names/judged_once.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "diagnosis/frame/accelerations.hpp"
#include "diagnosis/frame/middle.hpp"
#include "diagnosis/model/motion_error.hpp"
#include "diagnosis/proof/held_out_error.hpp"
#include "diagnosis/proof/series.hpp"
#include "diagnosis/search/bandwidths.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

constexpr int kPasses = 2;  // the columns of some causes follow the fit

bool is_one_of(const std::vector<std::string>& ids, const std::string& id) {
  return std::ranges::count(ids, id) > 0;
}

const Segment* segment_of(const Frame& frame, const std::string& id) {
  const auto found = std::ranges::find(frame.segments, id, &Segment::id);
  return found == frame.segments.end() ? nullptr : &*found;
}

// Where the search moved a recording's zero, it stays moved.
void take_zeros(const Frame& from, Frame& to) {
  if (to.zero != from.zero) {
    to.torsion += to.zero - from.zero;
    to.zero = from.zero;
    if (to.rig == Rig::specimen) to.load_angle = to.motor_angle = to.torsion;
  }
  for (Segment& s : to.segments) {
    const Segment* known = segment_of(from, s.id);
    if (known == nullptr || !from.own_zeros) continue;
    to.torsion.segment(s.first, s.count) += s.zero - known->zero;
    s.zero = known->zero;
  }
  if (from.own_zeros) to.load_angle = to.motor_angle = to.torsion;
}

// Of each recording what follows the first row that is held.
ArrayXd taken_away(const Frame& frame, const ArrayXd& held) {
  ArrayXd gone = ArrayXd::Zero(frame.rows());
  for (const Segment& s : frame.segments) {
    Index first = 0;
    while (first < s.count && held[s.first + first] == 0.0) ++first;
    gone.segment(s.first + first, s.count - first).setOnes();
  }
  return gone;
}

// Accelerations as the search had them; of recordings that it had not, as its model fits them best.
void take_bandwidths(const Frame& from, const DriveModel& model, const ArrayXd& usable, Frame& to) {
  if (!to.accelerations) return;
  std::vector<std::size_t> bandwidths;
  std::vector<bool> unknown;
  for (const Segment& s : to.segments) {
    const Segment* known = segment_of(from, s.id);
    unknown.push_back(known == nullptr);
    bandwidths.push_back(known == nullptr ? 0 : known->bandwidth);
  }
  to = with_bandwidths(std::move(to), bandwidths);
  Frame all = to;
  all.usable = usable;
  to = with_bandwidths(std::move(to), bandwidths_for(all, model, unknown));
  to.torque_range = from.torque_range;
}

Judged all_rows(Frame whole, const ArrayXd& held, const Frame& searched) {
  Judged judged{std::move(whole), {}, {}, {}, {}};
  Frame& f = judged.frame;
  judged.held = held * f.usable;
  f.usable *= 1.0 - taken_away(f, held);
  f.equations = searched.equations;
  f.firm_spring = searched.firm_spring;
  take_zeros(searched, f);
  f.measure_torsion();
  f.speed_range = searched.speed_range;
  f.torque_range = searched.torque_range;
  return judged;
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

PerEquation of_motion_error(const Frame& frame, const DriveModel& model) {
  return torque_of_motion_error(frame, model, reference_of(frame, model));
}

Result<ModelFit> fitted_again(const Frame& frame, const Frame& searched, Findings findings) {
  const PerEquation of_motion = of_motion_error(frame, findings.fit.model);
  for (Equation equation : frame.equations) {
    const std::size_t e = index_of(equation);
    EquationNoise& noise = findings.noise[e];
    noise.level = levels_on(frame, searched, noise.level);
    noise.of_motion = of_motion[e];
    findings.weight[e] = weights_of(frame, equation, noise);
    findings.fit_weight[e] = weights_of_fit(frame, findings.weight[e], findings.noise[e].alike);
  }
  for (int pass = 0; pass < kPasses; ++pass) {
    findings.reference = reference_of(frame, findings.fit.model);
    const auto fitted = fit_all(frame, findings, kRefreshSteps, kJudgedFall);
    if (!fitted) return tl::unexpected(fitted.error());
  }
  return findings.fit;
}

/// The recordings that have rows that are judged.
Frame judged_frame(const Frame& all, const ArrayXd& held) {
  Frame frame = all;
  frame.usable = held;
  std::erase_if(frame.segments,
                [&](const Segment& s) { return held.segment(s.first, s.count).sum() == 0.0; });
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

Result<Judged> judge(Frame whole, const ArrayXd& held, const Finding& finding) {
  const auto& [searched, selection, known] = finding;
  const ArrayXd usable = whole.usable;
  Judged judged = all_rows(std::move(whole), held, searched);
  take_bandwidths(searched, selection.final.fit.model, usable, judged.frame);
  if (judged.frame.accelerations) judged.held *= judged.frame.accelerations_held;
  auto before = fitted_again(judged.frame, searched, selection.baseline);
  if (!before) return tl::unexpected(before.error());
  auto after = fitted_again(judged.frame, searched, selection.final);
  if (!after) return tl::unexpected(after.error());
  judged.before = std::move(*before);
  judged.after = std::move(*after);
  judged.of_motion = of_motion_error(judged.frame, judged.after.model);
  return judged;
}

HoldoutProof proof_on(const Frame& all, const ArrayXd& held, Equation equation,
                      const ArrayXd& before, const ArrayXd& after, const ArrayXd& of_motion) {
  const Frame frame = judged_frame(all, held);
  HoldoutProof p;
  p.nested = true;
  const ArrayXd rows = frame.rows_of(equation);
  p.rmse_before = rms_on(before, rows);
  p.rmse_after = rms_on(after, rows);
  p.ratio = p.rmse_after / p.rmse_before;
  p.noise_floor = noise_of(
      frame, noise_without(frame, equation, frame.judged_part(equation, after), of_motion, {}),
      after, rows);
  take_interval(frame, rows, before, after, p);
  if (equation != Equation::motor) return p;
  for (double* value : {&p.rmse_before, &p.rmse_after, &p.noise_floor}) *value *= all.ratio;
  return p;
}

Result<JudgedOnce> judged_once(const RecordingSet& all, const std::vector<std::string>& ids,
                               const Finding& finding, Index most_rows) {
  const Equation equation = equation_to_prove(finding.frame, finding.selection);
  auto whole = make_frame(all, most_rows);
  if (!whole) return tl::unexpected(whole.error());
  ArrayXd rows = ArrayXd::Zero(whole->rows());
  for (const Segment& s : whole->segments) {
    if (is_one_of(ids, s.id)) rows.segment(s.first, s.count).setOnes();
  }
  const auto judged = judge(std::move(*whole), rows, finding);
  if (!judged) return tl::unexpected(judged.error());
  const auto& [frame, held, before, after, of_motion] = *judged;
  const std::size_t e = index_of(equation);
  JudgedOnce once{
      proof_on(frame, held, equation, before.residual[e], after.residual[e], of_motion[e]),
      series_of(judged_frame(frame, held), equation, before.prediction[e], after.prediction[e])};
  once.proof.recordings = ids;
  for (DiagnosedSeries& series : once.series) series.split = Split::holdout;
  return once;
}

}  // namespace flexspline::studies
