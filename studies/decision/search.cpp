#include "decision/search.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace flexspline::studies::decision {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr std::size_t kRefined = 3;  // candidates fitted whole before a round gives up
constexpr double kClose = 0.6;       // of the best gain: fitted whole before one is taken
constexpr double kOptimism = 2.0;    // a fit may gain that much more than its screening
constexpr std::size_t kRounds = 6;
constexpr double kFirstStep = 1.5;  // of a shape that is walked
constexpr double kLastStep = 1.05;
constexpr double kWorthAStep = 0.1;  // nats

bool walked(const CauseForm& form, const Shape& shape) { return !steps(form) && !shape.discrete; }

double moved(const Shape& s, double value, double step) {
  if (s.logarithmic) return std::clamp(value * step, s.lower, s.upper);
  const double by = (step > 1.0 ? step - 1.0 : 1.0 - 1.0 / step) * 0.5 * (s.upper - s.lower);
  return std::clamp(value + (step > 1.0 ? by : -by), s.lower, s.upper);
}

// Log likelihood with another shape in place of a cause's own, variances and baseline as they are:
// the change of its columns, or of the residual.
double likelihood_of(const Bench& bench, const Fit& fit, std::size_t i, const Taken& other) {
  std::vector<Gram> grams;
  std::vector<Reduced> reduced;
  FixedEffects columns = fit.system.columns;
  const Index at = fit.system.grams.front().ww.cols();
  const bool whole = other.form->transform != nullptr;
  const ByEquation own =
      whole ? change_by(bench, fit.state, other) : columns_of(bench, fit.system, fit.state, other);
  const Index k = whole ? 1 : fit.system.count[i];
  for (std::size_t e = 0; e < bench.equations.size(); ++e) {
    MatrixXd one = MatrixXd::Zero(bench.equations[e].rows.size(), k);
    if (own[e].cols() > 0) one = own[e];
    grams.push_back(with_columns(bench, fit.system, e, one));
    reduced.push_back(reduce(grams.back(), fit.system.components[e], fit.ratio[e]));
  }
  if (whole) columns.whole = at;
  for (Index c = 0; c < k && !whole; ++c) {
    columns.free[static_cast<std::size_t>(fit.system.first[i] + c)] = at + c;
  }
  return solve(grams, reduced, columns).log_likelihood;
}

// One round of steps up and down over every walked shape; whether any moved.
bool walk(const Bench& bench, Fit& fit, double step) {
  bool any = false;
  double here = fit.log_likelihood;
  for (std::size_t i = 0; i < fit.state.causes.size(); ++i) {
    const Taken own = fit.state.causes[i];
    if (own.form->shapes == nullptr) continue;
    const auto shapes = own.form->shapes(*bench.frame);
    for (std::size_t k = 0; k < shapes.size(); ++k) {
      if (!walked(*own.form, shapes[k])) continue;
      for (const double by : {step, 1.0 / step}) {
        Taken other = fit.state.causes[i];
        other.shape[k] = moved(shapes[k], other.shape[k], by);
        if (other.shape[k] == fit.state.causes[i].shape[k]) continue;
        const double there = likelihood_of(bench, fit, i, other);
        if (!(there > here + kWorthAStep)) continue;
        DriveState state = fit.state;
        state.causes[i].shape = other.shape;
        Fit next = fit_state(bench, state, fit.ratio, 1);
        if (!(next.log_likelihood > fit.log_likelihood + kWorthAStep)) continue;
        fit = std::move(next);
        here = fit.log_likelihood;
        any = true;
        break;
      }
    }
  }
  return any;
}

bool has_walked(const Bench& bench, const DriveState& state) {
  return std::ranges::any_of(state.causes, [&](const Taken& t) {
    if (t.form->shapes == nullptr) return false;
    return std::ranges::any_of(t.form->shapes(*bench.frame),
                               [&](const Shape& s) { return walked(*t.form, s); });
  });
}

// Causes whose score is not missed, the least first.
Fit shed(const Bench& bench, Fit fit, const Calibration& calibration) {
  for (bool again = true; again && fit.state.causes.size() > 1;) {
    again = false;
    for (std::size_t i = 0; i < fit.state.causes.size(); ++i) {
      Fit less = without(bench, fit, i);
      if (log_odds(fit.score - less.score, calibration) > 0.0) continue;
      fit = std::move(less);
      again = true;
      break;
    }
  }
  return fit;
}

}  // namespace

double log_odds(double gain, const Calibration& calibration) {
  return calibration.power * gain - std::log(static_cast<double>(causes().size()));
}

Fit with_walked_shapes(const Bench& bench, Fit fit) {
  if (!has_walked(bench, fit.state)) return fit;
  for (double step = kFirstStep; step > kLastStep;) {
    if (!walk(bench, fit, step)) step = std::sqrt(step);
  }
  return fit;
}

Fit extended(const Bench& bench, const Fit& fit, const Taken& cause) {
  DriveState state = fit.state;
  state.causes.push_back(cause);
  const int passes = steps(*cause.form) ? 4 : 2;
  // In the remainder's place: the cause first, then what it leaves.
  Fit alone = fit_state(bench, state, fit.ratio, passes, Remainder::none);
  alone = with_walked_shapes(bench, std::move(alone));
  alone = refit(bench, alone, alone.state, 3);
  if (fit.components == 0) return alone;
  Fit beside = refit(bench, fit, state, passes);
  beside = with_walked_shapes(bench, std::move(beside));
  return beside.score > alone.score ? beside : alone;
}

Fit without(const Bench& bench, const Fit& fit, std::size_t cause) {
  DriveState state = fit.state;
  state.causes.erase(state.causes.begin() + static_cast<std::ptrdiff_t>(cause));
  Fit rest = fit_state(bench, std::move(state), {}, 5);
  prune(bench, rest);
  return rest;
}

double promise(const Candidate& one, const Fit& fit) {
  const double replaced = one.gain + kNameless * fit.components;
  return fit.components == 0 ? one.gain : std::max(one.gain, std::min(one.instead, replaced));
}

Fit search(const Bench& bench, Fit fit, const Calibration& calibration) {
  for (std::size_t round = 0; round < kRounds; ++round) {
    auto candidates = screen(bench, fit);
    std::ranges::stable_sort(candidates, std::ranges::greater{},
                             [&](const Candidate& c) { return promise(c, fit); });
    std::optional<Fit> best;
    for (std::size_t k = 0; k < std::min(kRefined, candidates.size()); ++k) {
      const Candidate& one = candidates[k];
      const double most = promise(one, fit);
      const bool close = most > kClose * promise(candidates.front(), fit);
      if ((best && !close) || log_odds(kOptimism * most, calibration) < 0.0) continue;
      Fit next = extended(bench, fit, one.cause);
      if (!best || next.score > best->score) best = std::move(next);
    }
    const bool taken =
        best && log_odds(best->score - fit.score, calibration) >
                    std::log(calibration.probability / (1.0 - calibration.probability));
    if (taken) fit = std::move(*best);
    if (!taken) break;
    fit = shed(bench, std::move(fit), calibration);
  }
  return fit;
}

}  // namespace flexspline::studies::decision
