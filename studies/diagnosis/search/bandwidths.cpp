#include "diagnosis/search/bandwidths.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <fmt/format.h>

#include "diagnosis/frame/accelerations.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;

constexpr double kGain = 0.05;  // of an error

std::vector<std::size_t> all_at(const Frame& frame, std::size_t k) {
  return std::vector<std::size_t>(frame.segments.size(), k);
}

// Smoothed without end, a torque that is told by an acceleration is explained by no law at all.
bool is_told_by(const Frame& frame, Equation equation) {
  return equation != Equation::torsion || !frame.torque_by_inertia;
}

/// Rows that every bandwidth lets be judged, the same for all of them.
class JudgedByAll {
 public:
  explicit JudgedByAll(const Frame& frame) : frame_(frame), held_(ArrayXd::Ones(frame.rows())) {
    for (const Accelerations& one : *frame.accelerations) held_ *= one.held;
  }

  double count(const Segment& s) const {
    double sum = 0.0;
    for (Equation equation : frame_.equations) {
      if (!is_told_by(frame_, equation)) continue;
      sum += rows(equation).segment(s.first, s.count).sum();
    }
    return sum;
  }

  /// Rows times the logarithm of the residual's root mean square, by segment, summed over the
  /// equations: less the logarithm of its likelihood.
  std::vector<double> misfits(const PerEquation& residual) const {
    std::vector<double> misfit(frame_.segments.size(), 0.0);
    for (Equation equation : frame_.equations) {
      if (!is_told_by(frame_, equation)) continue;
      const ArrayXd all = rows(equation);
      const ArrayXd square = all * residual[index_of(equation)].square();
      for (std::size_t i = 0; i < misfit.size(); ++i) {
        const Segment& s = frame_.segments[i];
        const double n = all.segment(s.first, s.count).sum();
        const double sum = square.segment(s.first, s.count).sum();
        if (sum > 0.0) misfit[i] += 0.5 * n * std::log(sum / n);
      }
    }
    return misfit;
  }

  double misfit(const Findings& model) const {
    const auto by_segment = misfits(model.fit.residual);
    return std::reduce(by_segment.begin(), by_segment.end());
  }

 private:
  ArrayXd rows(Equation equation) const { return frame_.rows_of(equation) * held_; }

  const Frame& frame_;
  ArrayXd held_;
};

}  // namespace

std::vector<std::size_t> bandwidths_of(const Frame& frame) {
  std::vector<std::size_t> list;
  for (const Segment& s : frame.segments) list.push_back(s.bandwidth);
  return list;
}

std::vector<std::size_t> bandwidths_for(const Frame& frame, const DriveModel& model,
                                        const std::vector<bool>& asked) {
  const JudgedByAll judged(frame);
  std::vector<std::vector<double>> misfits;
  for (std::size_t k = 0; k < frame.accelerations->size(); ++k) {
    const Frame other = with_bandwidths(frame, all_at(frame, k));
    misfits.push_back(judged.misfits(evaluate(other, model, reference_of(other, model)).residual));
  }
  std::vector<std::size_t> best = bandwidths_of(frame);
  for (std::size_t i = 0; i < best.size(); ++i) {
    if (!asked[i]) continue;
    best[i] = 0;
    double least = misfits[0][i] - kGain * judged.count(frame.segments[i]);
    for (std::size_t k = 1; k < misfits.size(); ++k) {
      if (misfits[k][i] < least) least = misfits[k][i], best[i] = k;
    }
  }
  return best;
}

std::vector<std::size_t> best_bandwidths(const Frame& frame, const Findings& model) {
  const JudgedByAll judged(frame);
  Findings best = model;
  double least = judged.misfit(model);
  // The first octave takes most of the noise: where it leaves more, the next do.
  for (std::size_t k = 1; k < frame.accelerations->size(); ++k) {
    const Frame other = with_bandwidths(frame, all_at(frame, k));
    Findings fitted = best;
    if (!refresh(other, fitted, kRefreshSteps)) break;
    const double misfit = judged.misfit(fitted);
    if (misfit >= least) break;
    least = misfit, best = std::move(fitted);
  }
  return bandwidths_for(frame, best.fit.model, std::vector(frame.segments.size(), true));
}

std::string bandwidths_in_words(const Frame& frame) {
  double narrowest = std::numeric_limits<double>::infinity();
  std::size_t count = 0;
  for (const Segment& s : frame.segments) {
    if (s.bandwidth == 0) continue;
    ++count;
    narrowest = std::min(narrowest, frame.motor_bandwidth[s.first]);
  }
  if (count == 0) return "";
  return fmt::format(
      "the accelerations of {} of {} recordings are smoothed further than their angles, to {:.3g} "
      "rad/s or more: what is faster moves no torque",
      count, frame.segments.size(), narrowest);
}

}  // namespace flexspline::studies
