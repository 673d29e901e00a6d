#include "diagnosis/selection.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace flexspline::studies {
namespace {

constexpr int kRefreshSteps = 8;

bool admissible(const Trial& trial, const Limits& limits) {
  if (trial.cause.row == nullptr || trial.net_gain < limits.net_gain) return false;
  return trial.cause.form->transform != nullptr || trial.size < limits.taken_up;
}

// Sums of squares of an equation with the same weights: before, after, and what noise asks for.
struct Misfit {
  double before = 0.0;
  double after = 0.0;
  double noise = 0.0;
};

Misfit misfit_of(const Findings& base, const Findings& final, Equation equation) {
  const std::size_t e = index_of(equation);
  const auto& weight = final.weight[e];
  return {(base.fit.residual[e] * weight).square().sum(),
          (final.fit.residual[e] * weight).square().sum(),
          static_cast<double>((weight > 0.0).count())};
}

void measure_success(const Frame& frame, Selection& s) {
  double before = 0.0;
  double after = 0.0;
  for (Equation equation : frame.equations) {
    const Misfit m = misfit_of(s.baseline, s.final, equation);
    const double colour = s.final.noise[index_of(equation)].colour;
    before += std::max(m.before - m.noise, 0.0) / colour;
    after += std::max(m.after - m.noise, 0.0) / colour;
  }
  s.removed = before > 0.0 ? std::clamp(1.0 - after / before, 0.0, 1.0) : 0.0;
}

bool is_left(const CoordinateScore& score, const Limits& limits) {
  return score.statistic > limits.remainder && score.share > limits.remainder_share;
}

double worst_misfit(const Frame& frame, const Findings& findings) {
  double worst = 0.0;
  for (Equation equation : frame.equations) {
    const Misfit m = misfit_of(findings, findings, equation);
    worst = std::max(worst, m.after / m.noise);
  }
  return worst;
}

/// Weighted sums of squares over all equations: what the causes took, what a coordinate still
/// orders, and what there was.
struct Balance {
  double taken = 0.0;
  double ordered = 0.0;
  double before = 0.0;
};

Balance balance_of(const Frame& frame, const Selection& s) {
  Balance b;
  for (Equation equation : frame.equations) {
    const Misfit m = misfit_of(s.baseline, s.final, equation);
    b.before += m.before;
    b.taken += m.before - m.after;
    for (const CoordinateScore& score : s.after) {
      if (score.equation != equation) continue;
      b.ordered += score.share * m.after;
      break;
    }
  }
  return b;
}

// The causes stand where they leave little that anything could order, and remove most of the
// misfit, or leave no more than noise does.
bool explains_enough(const Frame& frame, const Selection& s, const Limits& limits) {
  const Balance b = balance_of(frame, s);
  const double left = s.after.empty() ? 0.0 : s.after.front().statistic;
  if (left > limits.remainder && b.taken < limits.explained * (b.taken + b.ordered)) return false;
  return s.removed >= limits.explained || worst_misfit(frame, s.final) < limits.misfit ||
         b.taken > limits.half * b.before;
}

double chi_square_rise(const Frame& frame, const Findings& findings, const ModelFit& fit) {
  double rise = 0.0;
  for (Equation equation : frame.equations) {
    const std::size_t e = index_of(equation);
    rise += (fit.sum_of_squares[e] - findings.fit.sum_of_squares[e]) / findings.noise[e].colour;
  }
  return rise;
}

bool stands_for(const Accepted& a, const Accepted& b) {
  return std::ranges::any_of(a.rivals,
                             [&](const Trial& t) { return t.cause.row == b.trial.cause.row; });
}

bool share_equation(const Accepted& a, const Accepted& b) {
  return std::ranges::any_of(a.trial.cause.form->at, [&](Equation e) {
    return std::ranges::count(b.trial.cause.form->at, e) > 0;
  });
}

// Of two causes in one equation, what a small one explains may be no more than the form of the
// large one.
bool in_the_shadow(const Selection& s, std::size_t i, const std::vector<double>& loss,
                   const Limits& limits) {
  for (std::size_t k = 0; k < s.accepted.size(); ++k) {
    const Accepted& small = s.accepted[i];
    const Accepted& large = s.accepted[k];
    if (k == i || !share_equation(small, large)) continue;
    const bool twins = stands_for(small, large) || stands_for(large, small);
    const double limit = twins ? limits.twin_shadow : limits.shadow;
    const double worth = twins ? std::max(small.first_gain, large.first_gain) : loss[k];
    if (loss[i] < limit * worth) return true;
  }
  return false;
}

// A cause that the later ones made needless goes again.
Result<void> take_out_needless(const Frame& frame, const Limits& limits, Selection& s) {
  for (bool changed = true; changed && s.accepted.size() > 1;) {
    changed = false;
    std::vector<ModelFit> without;
    std::vector<double> loss;
    for (std::size_t i = 0; i < s.accepted.size(); ++i) {
      auto fit = reduced(frame, s.final, i, kRefreshSteps);
      if (!fit) return tl::unexpected(fit.error());
      loss.push_back(chi_square_rise(frame, s.final, *fit));
      s.accepted[i].trial.gain = loss.back();
      without.push_back(std::move(*fit));
    }
    const auto least = static_cast<std::size_t>(std::ranges::min_element(loss) - loss.begin());
    if (loss[least] > limits.net_gain && !in_the_shadow(s, least, loss, limits)) break;
    s.final.fit = std::move(without[least]);
    s.accepted.erase(s.accepted.begin() + static_cast<long>(least));
    const auto again = refresh(frame, s.final, kRefreshSteps);
    if (!again) return again;
    changed = true;
  }
  return {};
}

Accepted accept(std::vector<Trial> trials, std::size_t best, const Limits& limits) {
  Accepted accepted;
  accepted.trial = std::move(trials[best]);
  accepted.first_gain = accepted.trial.gain;
  accepted.material =
      accepted.trial.size >= limits.size && accepted.trial.net_gain >= limits.named_gain;
  for (std::size_t i = 0; i < trials.size(); ++i) {
    if (i == best || trials[i].cause.row == nullptr) continue;
    const bool alike =
        trials[i].gain > limits.alike * accepted.trial.gain && admissible(trials[i], limits);
    (alike ? accepted.rivals : accepted.field).push_back(std::move(trials[i]));
  }
  return accepted;
}

// Immaterial causes first, in the lists as in the model.
void put_immaterial_first(Selection& s) {
  DriveModel& model = s.final.fit.model;
  const DriveModel mixed = model;
  std::vector<Accepted> material;
  model.causes.clear();
  model.coefficients.clear();
  for (const bool wanted : {false, true}) {
    for (std::size_t i = 0; i < s.accepted.size(); ++i) {
      if (s.accepted[i].material != wanted) continue;
      model.causes.push_back(mixed.causes[i]);
      model.coefficients.push_back(mixed.coefficients[i]);
      (wanted ? material : s.immaterial).push_back(s.accepted[i]);
    }
  }
  s.accepted = std::move(material);
}

// The baseline that the causes are measured against: all but the material ones.
Result<void> fit_baseline_again(const Frame& frame, Selection& s) {
  if (s.immaterial.empty()) return {};
  if (s.accepted.empty()) {
    s.baseline = s.final;
    return {};
  }
  Findings base = s.final;
  for (std::size_t i = s.accepted.size(); i > 0; --i) {
    auto fit = reduced(frame, base, s.immaterial.size() + i - 1, kRefreshSteps);
    if (!fit) return tl::unexpected(fit.error());
    base.fit = std::move(*fit);
  }
  s.baseline = std::move(base);
  return refresh(frame, s.baseline, kRefreshSteps);
}

Result<void> search(const Frame& frame, const Limits& limits, Selection& s,
                    const std::function<void(double, std::string_view)>& progress) {
  for (int round = 0; round < limits.rounds; ++round) {
    if (progress) progress(0.2 + 0.07 * round, fmt::format("trying causes, round {}", round + 1));
    auto trials = try_causes(frame, s.final);
    const auto best =
        std::ranges::find_if(trials, [&](const Trial& trial) { return admissible(trial, limits); });
    if (best == trials.end()) {
      s.last_field = std::move(trials);
      return {};
    }
    s.final.fit = best->fit;
    s.accepted.push_back(
        accept(std::move(trials), static_cast<std::size_t>(best - trials.begin()), limits));
    const auto again = refresh(frame, s.final, kRefreshSteps);
    if (!again) return again;
  }
  return {};
}

void withdraw(Selection& s) {
  s.withdrawn = std::move(s.accepted);
  s.accepted.clear();
  s.final = s.baseline;
  s.after = s.before;
  s.removed = 0.0;
}

}  // namespace

Result<Selection> select_causes(const Frame& frame, const Limits& limits,
                                const std::function<void(double, std::string_view)>& progress) {
  auto baseline = fit_baseline(frame);
  if (!baseline) return tl::unexpected(baseline.error());
  Selection s;
  s.baseline = *baseline;
  s.final = std::move(*baseline);
  const auto found = search(frame, limits, s, progress);
  if (!found) return tl::unexpected(found.error());
  const auto cleared = take_out_needless(frame, limits, s);
  if (!cleared) return tl::unexpected(cleared.error());
  put_immaterial_first(s);
  const auto based = fit_baseline_again(frame, s);
  if (!based) return tl::unexpected(based.error());
  s.before = locate(frame, s.baseline);
  s.after = locate(frame, s.final);
  measure_success(frame, s);
  if (!s.accepted.empty() && !explains_enough(frame, s, limits)) withdraw(s);
  s.remainder = (!s.after.empty() && is_left(s.after.front(), limits)) ||
                worst_misfit(frame, s.final) > 2.0 * limits.misfit;
  return s;
}

}  // namespace flexspline::studies
