#include "midpoint/steady_cycle.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <fmt/format.h>
#include <boost/math/tools/toms748_solve.hpp>

namespace flexspline::estimators {
namespace {

constexpr int kPhases = 1024;
constexpr std::uintmax_t kMostEvaluations = 100;
constexpr int kBits = 50;        // of a crossing
constexpr double kBlend = 0.25;  // of a cycle, in which a reconstruction passes into its series
constexpr double kTurn = 0.02;   // of the range: a smaller way back is no turn

}  // namespace

SteadyCycle::SteadyCycle(const Reconstruction& smooth, const TorsionRecord& record,
                         const SteadyPart& steady)
    : motion_(record.time, smooth.motion.position),
      speed_(record.time, smooth.motion.velocity),
      effort_(record.time, record.effort),
      first_(record.time[steady.first]),
      last_(record.time[steady.last - 1]),
      window_(first_ + (steady.first > 0 ? kBlend * steady.period : 0.0)),
      period_(steady.period),
      cycles_(steady.cycles) {}

Result<SteadyCycle> SteadyCycle::of(const TorsionRecord& record, const SteadyPart& steady) {
  const auto smooth = reconstruct(record);
  if (!smooth) return tl::unexpected(smooth.error());
  SteadyCycle cycle(*smooth, record, steady);
  if (auto found = cycle.find_turns(record.id); !found) return tl::unexpected(found.error());
  return cycle;
}

double SteadyCycle::wrapped(double t) const {
  const double turns = (t - window_) / period_;
  return window_ + (turns - std::floor(turns)) * period_;
}

Result<void> SteadyCycle::find_turns(const std::string& id) {
  const double step = period_ / kPhases;
  double low = motion(window_), high = low;
  crest_ = trough_ = window_;
  for (int k = 1; k < kPhases; ++k) {
    const double t = window_ + k * step;
    const double x = motion(t);
    if (x > high) high = x, crest_ = t;
    if (x < low) low = x, trough_ = t;
  }
  crest_after_trough_ = crest_ + (crest_ < trough_ ? period_ : 0.0);
  trough_after_crest_ = trough_ + (trough_ < crest_ ? period_ : 0.0);
  const double allowed = kTurn * (high - low);
  const auto monotone = [&](double from, double to, double sign) {
    double furthest = sign * motion(from);
    for (double t = from; t < to; t += step) {
      const double reached = sign * motion(t);
      furthest = std::max(furthest, reached);
      if (furthest - reached > allowed) return false;
    }
    return true;
  };
  if (!monotone(trough_, crest_after_trough_, 1.0) ||
      !monotone(crest_, trough_after_crest_, -1.0)) {
    return failure(ErrorCode::numerics,
                   fmt::format("the motion of recording {} turns more than twice a cycle", id),
                   "the midpoint method pairs the two branches of one loop: record a loop that "
                   "turns at its ends alone, or use static_regression or trajectory_ceres");
  }
  return {};
}

double SteadyCycle::crossing(double from, double to, double x) const {
  const auto beyond = [this, x](double t) { return motion(t) - x; };
  const double at_from = beyond(from), at_to = beyond(to);
  if ((at_from < 0.0) == (at_to < 0.0)) return std::abs(at_from) < std::abs(at_to) ? from : to;
  std::uintmax_t most = kMostEvaluations;
  const auto [before, after] = boost::math::tools::toms748_solve(
      beyond, from, to, at_from, at_to, boost::math::tools::eps_tolerance<double>(kBits), most);
  return 0.5 * (before + after);
}

double SteadyCycle::effort(double t) const {
  double sum = 0.0;
  int count = 0;
  for (double at = t - std::floor((t - first_) / period_) * period_; at <= last_; at += period_) {
    sum += effort_.value(at);
    ++count;
  }
  return count > 0 ? sum / count : effort_.value(t);
}

}  // namespace flexspline::estimators
