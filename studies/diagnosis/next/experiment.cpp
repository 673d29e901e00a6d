#include "diagnosis/next/experiment.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include "diagnosis/frame/middle.hpp"
#include "diagnosis/next/next_motion.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;

constexpr double kSeparated = 5.0;  // standard deviations

/// Expected distance of two models along a motion, in standard deviations of the noise: over all
/// equations that both predict.
double separation(const Frame& frame, const DriveModel& a, const DriveModel& b,
                  const std::array<EquationNoise, 3>& noise) {
  const ModelFit one = evaluate(frame, a, reference_of(frame, a));
  const ModelFit other = evaluate(frame, b, reference_of(frame, b));
  double squares = 0.0;
  for (Equation equation : frame.equations) {
    const std::size_t e = index_of(equation);
    if (one.prediction[e].size() != other.prediction[e].size()) continue;
    const double level = middle(noise[e].level);
    if (!(level > 0.0)) continue;
    squares += ((one.prediction[e] - other.prediction[e]) / level).square().sum();
  }
  return std::sqrt(squares);
}

/// Two causes of which the recordings do not decide, each in its model.
struct Pair {
  const Trial* best;
  const Trial* other;
};

/// The first that has a name; null where none has.
const Trial* first_name(const std::vector<Trial>& trials) {
  const auto found = std::ranges::find_if(
      trials, [](const Trial& t) { return t.cause.row != nullptr && t.cause.row->in_catalogue(); });
  return found == trials.end() ? nullptr : &*found;
}

/// Every cause with its closest alternative; the first also with what came next behind it.
std::vector<Pair> undecided_pairs(const Selection& s) {
  std::vector<Pair> pairs;
  for (const Accepted& accepted : s.accepted) {
    const bool first = &accepted == &s.accepted.front();
    const Trial* other = first_name(accepted.rivals);
    if (other == nullptr && first) other = first_name(accepted.field);
    if (other != nullptr) pairs.push_back({&accepted.trial, other});
  }
  return pairs;
}

std::string in_words(const NextExperiment& next, const std::string& motion) {
  if (next.separation_sigma < kSeparated) {
    return fmt::format(
        "no motion within the recorded limits separates {} from {}: z = {:.1f} at best, {} of "
        "{:.3g} Hz; record further or faster",
        next.separates[0], next.separates[1], next.separation_sigma, motion, next.frequency_hz);
  }
  return fmt::format("{} of {:.3g} Hz, three cycles: expected to separate {} from {} (z = {:.0f})",
                     motion, next.frequency_hz, next.separates[0], next.separates[1],
                     next.separation_sigma);
}

/// The motion along which the models of a pair differ most.
std::optional<NextExperiment> best_of(const std::vector<NextMotion>& motions, const Pair& pair,
                                      const std::array<EquationNoise, 3>& noise) {
  NextExperiment next;
  next.separation_sigma = 0.0;
  std::string motion;
  for (const NextMotion& one : motions) {
    const double z = separation(one.frame, pair.best->fit.model, pair.other->fit.model, noise);
    if (!(z > next.separation_sigma)) continue;
    next.separation_sigma = z;
    next.amplitude = one.amplitude;
    next.frequency_hz = one.frequency_hz;
    motion = one.says;
  }
  if (!(next.separation_sigma > 0.0)) return std::nullopt;
  next.separates = {std::string(pair.best->cause.row->id), std::string(pair.other->cause.row->id)};
  next.excitation = "sine";
  next.says = in_words(next, motion);
  return next;
}

}  // namespace

bool one_loop(const Frame& frame) {
  if (frame.travels || !frame.has(Equation::torsion) || frame.rig == Rig::free) return false;
  const auto alike = [](const ArrayXd& channel, const Frame& f) {
    double least = std::numeric_limits<double>::infinity();
    double most = 0.0;
    for (const Segment& s : f.segments) {
      const double range = channel.segment(s.first, s.count).abs().maxCoeff();
      least = std::min(least, range);
      most = std::max(most, range);
    }
    return least > 0.9 * most;
  };
  return alike(frame.torsion, frame) && alike(frame.torsion_rate, frame);
}

NextExperiment another_rate(const Frame& frame) {
  NextExperiment next;
  next.separates = {"presliding_hysteresis", "viscous damping"};
  next.excitation = "sine";
  next.amplitude = frame.torsion_range;
  next.frequency_hz = 0.25 * frame.rate_range / (2.0 * std::numbers::pi * frame.torsion_range);
  next.says = fmt::format(
      "the same amplitude at {:.3g} Hz: what is viscous shrinks with the rate, what is a memory "
      "does "
      "not",
      next.frequency_hz);
  return next;
}

std::vector<NextExperiment> next_experiments(const Frame& frame, const Selection& s) {
  std::vector<NextExperiment> list;
  for (const Pair& pair : undecided_pairs(s)) {
    const auto motions = next_motions(frame, pair.best->fit.model);
    if (auto next = best_of(motions, pair, s.final.noise)) list.push_back(std::move(*next));
  }
  return list;
}

}  // namespace flexspline::studies
