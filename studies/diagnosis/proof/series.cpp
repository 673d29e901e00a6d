#include "diagnosis/proof/series.hpp"

#include <algorithm>

#include "diagnosis/frame/folds.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

constexpr Index kSeriesPoints = 400;

// The first and the last row of a segment that count: what a recording begins with may be the end
// of something before it.
std::pair<Index, Index> judged_rows(const Frame& frame, const Segment& segment) {
  Index first = segment.first;
  Index last = segment.first + segment.count - 1;
  while (first < last && frame.usable[first] == 0.0) ++first;
  while (last > first && frame.usable[last] == 0.0) --last;
  return {first, last};
}

// An incident is left out, and has to be seen.
Frame with_incidents(Frame frame) {
  for (const Incident& one : frame.incidents) frame.usable.segment(one.first, one.count).setOnes();
  return frame;
}

}  // namespace

std::vector<DiagnosedSeries> series_of(const Frame& judged_on, Equation equation,
                                       const ArrayXd& prediction_before,
                                       const ArrayXd& prediction_after) {
  const Frame frame = with_incidents(judged_on);
  const ArrayXd before = frame.judged_part(equation, prediction_before);
  const ArrayXd after = frame.judged_part(equation, prediction_after);
  const bool winds_up = equation == Equation::torsion || frame.rig == Rig::locked;
  const ArrayXd& motion = winds_up ? frame.torsion : frame.load_angle;
  const ArrayXd& rate = winds_up ? frame.torsion_rate : frame.load_speed;
  std::vector<DiagnosedSeries> list;
  for (const Segment& segment : frame.segments) {
    DiagnosedSeries series;
    series.recording = segment.id;
    series.equation = name_of(equation);
    const Index stride = std::max<Index>(1, segment.count / kSeriesPoints);
    const ArrayXd& measured = equation == Equation::motor ? frame.motor_torque : frame.torque;
    const auto [first, last] = judged_rows(frame, segment);
    for (Index r = first; r <= last; r += stride) {
      series.time.push_back(frame.time[r]);
      series.motion.push_back(motion[r]);
      series.rate.push_back(rate[r]);
      series.measured.push_back(measured[r]);
      series.before.push_back(before[r]);
      series.after.push_back(after[r]);
      if (frame.rig != Rig::locked) series.motor_angle.push_back(frame.motor_angle[r]);
    }
    list.push_back(std::move(series));
  }
  return list;
}

std::vector<DiagnosedSeries> proved_series(const Frame& frame, const Selection& s,
                                           const Proof& proof) {
  const ArrayXd out = held_out(frame);
  auto list = series_of(frame, equation_to_prove(frame, s), proof.before, proof.after);
  for (std::size_t i = 0; i < list.size(); ++i) {
    list[i].split = out[frame.segments[i].first] > 0.0 ? Split::holdout : Split::train;
  }
  return list;
}

}  // namespace flexspline::studies
