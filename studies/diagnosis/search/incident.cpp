#include "diagnosis/search/incident.hpp"

#include <algorithm>
#include <cmath>

#include "diagnosis/search/step_incident.hpp"
#include "diagnosis/search/stretches.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

constexpr double kBeyondSearch = 18.0;  // nats; one in 10^7 searches of independent normal noise
constexpr double kShown = 0.05;         // of a recording: as finely as its place is told
constexpr double kAgain = 0.1;  // of its log likelihood: as much elsewhere, and it comes again
// Times that where a model's own misfit looks alike: a step as what it misses is slow, and at
// corners as one may be missed by more than another.
constexpr double kUnsure = 3.0;
constexpr double kMostOfIt = 0.8;  // of a recording: more is no incident, but the recording

// Whether no corner elsewhere is as sharp: what stands there may be the corner's own.
bool is_at_the_sharpest(const std::vector<Corners>& corners, std::size_t segment,
                        const Stretch& s) {
  const double own = corners[segment].sharpest(s.first, s.count);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Index n = corners[i].rows();
    const auto apart = static_cast<Index>(kApart * static_cast<double>(n));
    const Index before = i == segment ? std::max<Index>(0, s.first - apart) : n;
    const Index after = i == segment ? std::min(n, s.first + s.count + apart) : n;
    if (corners[i].sharpest(0, before) >= own) return false;
    if (corners[i].sharpest(after, n - after) >= own) return false;
  }
  return true;
}

// The largest of what there is beside a recording's best stretch, in all recordings.
double largest_beside(const Scan& scan, std::size_t segment) {
  double most = scan.best[segment].elsewhere;
  for (std::size_t i = 0; i < scan.best.size(); ++i) {
    if (i != segment) most = std::max(most, scan.best[i].nats);
  }
  return most;
}

/// Keeps the incident of the greatest log likelihood.
class Sought {
 public:
  Sought(const Frame& frame, const std::vector<Corners>& corners, const Limits& limits)
      : frame_(frame),
        corners_(corners),
        limits_(limits),
        chance_(std::log(static_cast<double>(frame.rows()))) {}

  /// usual: size of the residual over the noise; where the model misses more than that, its
  /// likelihood counts for less (quasi-likelihood: Wedderburn 1974).
  void take(const Scan& scan, Equation equation, const ArrayXd& residual, double usual) {
    const double dispersion = std::max(1.0, usual * usual);
    for (std::size_t i = 0; i < scan.best.size(); ++i) {
      const Stretch& s = scan.best[i];
      const Segment& segment = frame_.segments[i];
      // A search over so many stretches gains as much on noise.
      const double beyond = s.nats - chance_;
      const double least = kBeyondSearch * dispersion * (scan.unsure() ? kUnsure : 1.0);
      if (beyond < least || s.nats <= most_) continue;
      if (largest_beside(scan, i) - chance_ > kAgain * beyond) continue;
      if (static_cast<double>(s.count) > kMostOfIt * static_cast<double>(segment.count)) continue;
      if (scan.at_corners() && is_at_the_sharpest(corners_, i, s)) continue;
      keep(s.nats, {equation, i, segment.first + s.first, s.count, 0.0}, residual);
    }
  }

  void take(const std::optional<Step>& step, Equation equation, const ArrayXd& residual) {
    if (!step || step->nats - chance_ < kBeyondSearch || step->nats <= most_) return;
    const Segment& s = frame_.segments[step->segment];
    keep(step->nats, {equation, step->segment, s.first + step->first, s.count - step->first, 0.0},
         residual);
  }

  /// Null where there is none.
  const Incident* found() const { return most_ > 0.0 ? &found_ : nullptr; }

 private:
  // Unless it is too small to matter.
  void keep(double nats, Incident incident, const ArrayXd& residual) {
    const auto part = residual.segment(incident.first, incident.count);
    incident.size = std::sqrt(part.square().mean()) / frame_.largest_torque(incident.equation);
    if (incident.size < limits_.trifle()) return;
    most_ = nats;
    found_ = incident;
  }

  const Frame& frame_;
  const std::vector<Corners>& corners_;
  const Limits& limits_;
  double chance_;
  double most_ = 0.0;
  Incident found_{};
};

// No shorter than what is shown of it, about its middle, within its recording.
Incident shown(const Frame& frame, Incident incident) {
  const Segment& s = frame.segments[incident.segment];
  const Index least = static_cast<Index>(kShown * static_cast<double>(s.count));
  const Index more = std::max<Index>(0, least - incident.count);
  const Index last = std::min(s.first + s.count, incident.first + incident.count + (more + 1) / 2);
  incident.first = std::max(s.first, incident.first - more / 2);
  incident.count = last - incident.first;
  return incident;
}

}  // namespace

std::optional<Incident> find_incident(const Frame& frame, const Findings& findings,
                                      const Limits& limits) {
  std::vector<Corners> corners;
  for (const Segment& s : frame.segments) corners.emplace_back(frame, s);
  Sought sought(frame, corners, limits);
  for (const Equation equation : frame.equations) {
    const Scans scans(frame, corners, findings, equation);
    for (const Scan& scan : scans.all()) {
      sought.take(scan, equation, findings.fit.residual[index_of(equation)], scans.usual());
    }
    sought.take(step_taken(frame, findings, equation, limits), equation,
                findings.fit.residual[index_of(equation)]);
  }
  if (sought.found() == nullptr) return std::nullopt;
  return shown(frame, *sought.found());
}

Frame without_incident(Frame frame, const Incident& incident) {
  frame.usable.segment(incident.first, incident.count).setZero();
  frame.incidents.push_back(incident);
  return frame;
}

}  // namespace flexspline::studies
