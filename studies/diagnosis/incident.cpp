#include "diagnosis/incident.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "diagnosis/middle.hpp"
#include "diagnosis/running_parabola.hpp"
#include "diagnosis/step_incident.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

constexpr double kMedianSize = 0.6745;  // of a standard normal
constexpr double kOutlying = 4.0;  // standard deviations: a single row is worth eight nats at most
constexpr double kBeyondSearch = 18.0;  // nats; one in 10^7 searches of independent normal noise
constexpr Index kHalfWindow = 25;  // of the parabola about which a pulse stands, as the noise's
constexpr double kShown = 0.05;    // of a recording: as finely as its place is told
constexpr double kAgain = 0.1;     // of its log likelihood: as much elsewhere, and it comes again
constexpr double kCorner = 6.0;    // change of the acceleration in a row over the usual one
// Times that where a model's own misfit looks alike: a step as what it misses is slow, and at
// corners as one may be missed by more than another.
constexpr double kUnsure = 3.0;
constexpr Index kCornerRows = 10;
constexpr std::array kShares = {0.01, 0.025, 0.05, 0.1};  // of a recording: lengths of a stretch
constexpr std::array kPulses = {0.005, 0.0075, 0.01, 0.015};
constexpr Index kFewest = 6;       // rows of a stretch
constexpr Index kShortest = 4;     // rows of a pulse
constexpr double kApart = 0.1;     // of a recording: nearer is the same stretch
constexpr double kMostOfIt = 0.8;  // of a recording: more is no incident, but the recording

/// The best stretch of a recording, and the best that is apart from it.
struct Stretch {
  double nats = 0.0;
  Index first = 0;  ///< row of the recording
  Index count = 0;
  double elsewhere = 0.0;
};

ArrayXd running_sum(const ArrayXd& x) {
  ArrayXd sum(x.size() + 1);
  sum[0] = 0.0;
  for (Index i = 0; i < x.size(); ++i) sum[i + 1] = sum[i] + x[i];
  return sum;
}

double usual_size(const ArrayXd& z) {
  std::vector<double> sizes;
  for (const double value : z) {
    if (value != 0.0) sizes.push_back(std::abs(value));
  }
  return sizes.empty() ? 0.0 : middle(std::move(sizes)) / kMedianSize;
}

double usual_value(const ArrayXd& z) { return middle({z.begin(), z.end()}); }

// Log likelihood of a variance of its own, where it is larger than the recording's.
double power_nats(double mean_square, double rows) {
  if (!(mean_square > 1.0)) return 0.0;
  return 0.5 * rows * (mean_square - 1.0 - std::log(mean_square));
}

/// Where the motion of a recording has corners: there its acceleration is not known, nor is what
/// follows from it.
class Corners {
 public:
  Corners(const Frame& frame, const Segment& s) : sharpness_(ArrayXd::Zero(s.count)) {
    const ArrayXd a = frame.motor_acceleration.segment(s.first, s.count);
    const ArrayXd jump = (a.tail(a.size() - 1) - a.head(a.size() - 1)).abs();
    for (Index r = 0; r < s.count; ++r) {
      const Index from = std::max<Index>(0, r - kCornerRows);
      const Index to = std::min(jump.size(), r + kCornerRows);
      sharpness_[r] = jump.segment(from, to - from).maxCoeff();
    }
    const double usual = middle({jump.begin(), jump.end()});
    count_ = running_sum((sharpness_ > kCorner * usual).cast<double>());
  }

  bool at(Index row) const { return touched(row, 1); }
  /// Whether there is one among these rows, or so many further.
  bool touched(Index first, Index count, Index further = 0) const {
    const Index from = std::max<Index>(0, first - further);
    const Index to = std::min(sharpness_.size(), first + count + further);
    return count_[to] > count_[from];
  }
  /// Largest change of the acceleration in a row.
  double sharpest(Index first, Index count) const {
    return count > 0 ? sharpness_.segment(first, count).maxCoeff() : 0.0;
  }
  Index rows() const { return sharpness_.size(); }

 private:
  ArrayXd sharpness_;  ///< by row, within kCornerRows of it
  ArrayXd count_;      ///< running, of rows at a corner
};

/// The best of some stretches of a recording, all at corners of its motion or none.
class Best {
 public:
  Best(const Corners& corners, bool at_corners) : corners_(corners), at_corners_(at_corners) {}

  /// further: rows beside it that have a say in it.
  void take(double nats, Index first, Index count, Index further = 0) {
    if (corners_.touched(first, count, further) != at_corners_) return;
    tried_.push_back({nats, first, count, 0.0});
  }

  Stretch found() const {
    Stretch best;
    for (const Stretch& s : tried_) {
      if (s.nats > best.nats) best = s;
    }
    const auto apart = static_cast<Index>(kApart * static_cast<double>(corners_.rows()));
    for (const Stretch& s : tried_) {
      const bool far =
          s.first >= best.first + best.count + apart || s.first + s.count + apart <= best.first;
      if (far) best.elsewhere = std::max(best.elsewhere, s.nats);
    }
    return best;
  }

 private:
  const Corners& corners_;
  bool at_corners_;
  std::vector<Stretch> tried_;
};

void by_power(const ArrayXd& z, Best& best) {
  const ArrayXd sum = running_sum(z.max(-kOutlying).min(kOutlying).square());
  const Index n = z.size();
  for (const double share : kShares) {
    const Index width = std::max(kFewest, static_cast<Index>(share * static_cast<double>(n)));
    const double rows = static_cast<double>(width);
    for (Index i = 0; i + width <= n; i += std::max<Index>(1, width / 4)) {
      best.take(power_nats((sum[i + width] - sum[i]) / rows, rows), i, width);
    }
  }
}

// Long-run variance over variance, at least 1 (Newey and West 1987): by how much means of rows that
// follow each other scatter more than those of independent ones. The estimators' own ratio ends at
// forty lags, which what a model misses outlasts.
double long_run(const ArrayXd& z, Index lags) {
  double sum = z.square().sum();
  const double variance = sum;
  for (Index k = 1; k <= lags && k < z.size(); ++k) {
    const double weight = 1.0 - static_cast<double>(k) / static_cast<double>(lags + 1);
    sum += 2.0 * weight * (z.head(z.size() - k) * z.tail(z.size() - k)).sum();
  }
  return variance > 0.0 ? std::max(1.0, sum / variance) : 1.0;
}

// A mean from one row to the end that is another than before, held against how means of what is
// left beside the two wander: what a model misses is no step.
Stretch by_step(const ArrayXd& z) {
  const Index n = z.size();
  const ArrayXd sum = running_sum(z);
  const auto total = static_cast<double>(n);
  Stretch best;
  for (Index i = n / 10; i + n / 10 < n; ++i) {
    const auto before = static_cast<double>(i);
    const double contrast = sum[i] / before - (sum[n] - sum[i]) / (total - before);
    const double nats = 0.5 * contrast * contrast * before * (total - before) / total;
    if (nats > best.nats) best = {nats, i, n - i, 0.0};
  }
  if (best.count == 0) return best;
  ArrayXd about = z;
  auto later = about.tail(best.count);
  auto earlier = about.head(n - best.count);
  const double late = usual_value(later);
  const double early = usual_value(earlier);
  later -= late, earlier -= early;
  const double usual = usual_size(about);
  if (!(usual > 0.0)) return {};
  about = (about / usual).max(-kOutlying).min(kOutlying);
  const double contrast = (late - early) / usual + later.mean() - earlier.mean();
  const auto after = static_cast<double>(best.count);
  best.nats = 0.5 * contrast * contrast * after * (total - after) / total / long_run(about, n / 10);
  return best;
}

// A few rows beside the rest: their mean over that of as many rows anywhere in the recording.
void by_pulse(const ArrayXd& residual, Best& best) {
  const ArrayXd about = about_parabola(residual, parabola_weights(kHalfWindow));
  const double usual = usual_size(about);
  if (!(usual > 0.0)) return;
  const ArrayXd sum = running_sum((about / usual).max(-kOutlying).min(kOutlying));
  for (const double share : kPulses) {
    const Index width =
        std::max(kShortest, static_cast<Index>(share * static_cast<double>(residual.size())));
    const Index count = about.size() - width;
    if (count < 1) continue;
    const ArrayXd means = sum.segment(width, count) - sum.head(count);
    const double spread = std::max(usual_size(means), std::sqrt(static_cast<double>(width)));
    for (Index i = 0; i < count; ++i) {
      const double z = (sum[i + width] - sum[i]) / spread;
      best.take(0.5 * z * z, i + kHalfWindow, width, kHalfWindow);
    }
  }
}

/// The best stretch of every recording by one statistic.
struct Scan {
  enum class Of { steps, plain, corners };
  std::vector<Stretch> best;
  Of of = Of::plain;

  bool at_corners() const { return of == Of::corners; }
  bool unsure() const { return of != Of::plain; }
};

/// Stretches of an equation's residual by power, step and pulse, apart from corners and at them.
class Scans {
 public:
  Scans(const Frame& frame, const std::vector<Corners>& corners, const Findings& findings,
        Equation equation)
      : frame_(frame),
        corners_(corners),
        residual_(findings.fit.residual[index_of(equation)] * frame.rows_of(equation)),
        weighted_(residual_ * findings.weight[index_of(equation)]),
        at_corners_(usual_size(weighted_ * corner_rows())) {}

  /// Size of the residual over the noise.
  double usual() const { return usual_size(weighted_); }

  std::vector<Scan> all() const {
    std::vector<Scan> list = {
        {each([this](std::size_t i) { return by_step(weighted(i)); }), Scan::Of::steps}};
    for (const bool at_corners : {false, true}) {
      const auto best_of = [&](const auto& by) {
        return each([&](std::size_t i) {
          Best best(corners_[i], at_corners);
          by(i, best);
          return best.found();
        });
      };
      const double least = at_corners ? at_corners_ : 0.0;
      const auto power = [&](std::size_t i, Best& best) { by_power(normal(i, least), best); };
      const auto pulse = [&](std::size_t i, Best& best) { by_pulse(raw(i), best); };
      const auto of = at_corners ? Scan::Of::corners : Scan::Of::plain;
      list.push_back({best_of(power), of});
      list.push_back({best_of(pulse), of});
    }
    return list;
  }

 private:
  template <class By>
  std::vector<Stretch> each(const By& by) const {
    std::vector<Stretch> list;
    for (std::size_t i = 0; i < frame_.segments.size(); ++i) list.push_back(by(i));
    return list;
  }

  ArrayXd of_recording(const ArrayXd& x, std::size_t i) const {
    return x.segment(frame_.segments[i].first, frame_.segments[i].count);
  }
  ArrayXd raw(std::size_t i) const { return of_recording(residual_, i); }
  ArrayXd weighted(std::size_t i) const { return of_recording(weighted_, i); }
  // Over the recording's usual size, or a larger one.
  ArrayXd normal(std::size_t i, double least) const {
    const ArrayXd z = weighted(i);
    const double usual = std::max(usual_size(z), least);
    return usual > 0.0 ? ArrayXd(z / usual) : z;
  }
  ArrayXd corner_rows() const {
    ArrayXd rows = ArrayXd::Zero(frame_.rows());
    for (std::size_t i = 0; i < frame_.segments.size(); ++i) {
      const Segment& s = frame_.segments[i];
      for (Index r = 0; r < s.count; ++r) rows[s.first + r] = corners_[i].at(r) ? 1.0 : 0.0;
    }
    return rows;
  }

  const Frame& frame_;
  const std::vector<Corners>& corners_;
  ArrayXd residual_;
  ArrayXd weighted_;
  double at_corners_;  ///< usual size at corners, over the noise
};

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
