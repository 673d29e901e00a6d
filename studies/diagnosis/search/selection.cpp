#include "diagnosis/search/selection.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "diagnosis/search/exchange.hpp"
#include "diagnosis/search/explanation.hpp"
#include "diagnosis/search/needless.hpp"
#include "diagnosis/search/plain_form.hpp"

namespace flexspline::studies {
namespace {

bool admissible(const Trial& trial, const Limits& limits) {
  return trial.cause.row != nullptr && trial.net_gain >= limits.gain &&
         !is_taken_up(trial, limits) &&
         !is_no_part(*trial.cause.row, trial.fit.model.coefficients.back());
}

// The best, or a part of the baseline beside which it gains less than a name has to, in the first
// of its forms that does as well. One that has a shape more than it needs is no simpler than a
// cause.
std::size_t chosen(const std::vector<Trial>& trials, const Selection& s, const Limits& limits) {
  const auto may_be = [&](const Trial& trial) {
    return admissible(trial, limits) && std::ranges::count(s.redundant, trial.cause.row) == 0;
  };
  const auto best = std::ranges::find_if(trials, may_be);
  const auto goes_first = [&](const Trial& trial) {
    return may_be(trial) && goes_before(trial, *best, limits);
  };
  auto part = std::ranges::find_if(trials, goes_first);
  if (part == trials.end()) return static_cast<std::size_t>(best - trials.begin());
  for (auto other = part; other != trials.end(); ++other) {
    const bool plainer =
        other->cause.row == part->cause.row && other->cause.form < part->cause.form;
    if (plainer && goes_first(*other)) part = other;
  }
  return static_cast<std::size_t>(part - trials.begin());
}

bool is_material(const Trial& trial, const Limits& limits) {
  return !trial.cause.row->of_baseline() && trial.size >= limits.interest &&
         trial.net_gain >= limits.named_gain;
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

// Until nothing gains, or what does takes less than a share of the misfit that is left.
Result<void> search(const Frame& frame, const Limits& limits, Selection& s,
                    const std::function<void(double, std::string_view)>& progress,
                    double least_share) {
  for (int round = 0; round < limits.rounds; ++round) {
    if (progress) progress(0.2 + 0.07 * round, fmt::format("trying causes, round {}", round + 1));
    auto trials = try_causes(frame, s.final, limits.threads);
    const std::size_t best = chosen(trials, s, limits);
    if (best == trials.size() || trials[best].removed < least_share) {
      s.last_field = std::move(trials);
      return {};
    }
    s.final.fit = trials[best].fit;
    s.accepted.push_back(accept(std::move(trials), best, limits));
    const auto again = refresh(frame, s.final, kRefreshSteps);
    if (!again) return again;
  }
  return {};
}

Result<void> fit_again(const Frame& frame, Selection& s) {
  if (!s.accepted.empty()) return refresh(frame, s.final, kRefreshSteps);
  s.final = s.baseline;
  return {};
}

// The causes of another selection, fitted to this frame.
Result<void> take_causes(const Frame& frame, const Selection& from, Selection& s) {
  s.accepted = from.immaterial;
  s.accepted.insert(s.accepted.end(), from.accepted.begin(), from.accepted.end());
  s.redundant = from.redundant;
  s.final.fit.model = from.final.fit.model;
  return fit_again(frame, s);
}

}  // namespace

Accepted accept(std::vector<Trial> trials, std::size_t best, const Limits& limits) {
  Accepted accepted;
  accepted.trial = std::move(trials[best]);
  accepted.first_gain = accepted.trial.gain;
  accepted.material = is_material(accepted.trial, limits);
  for (std::size_t i = 0; i < trials.size(); ++i) {
    if (i == best || trials[i].cause.row == nullptr || trials[i].cause.row->of_baseline()) continue;
    const bool alike =
        trials[i].gain > limits.alike() * accepted.trial.gain && admissible(trials[i], limits);
    trials[i].fit.prediction = {};  // dozens are kept: their residuals say it too
    (alike ? accepted.rivals : accepted.field).push_back(std::move(trials[i]));
  }
  return accepted;
}

bool is_no_part(const CauseRow& row, const Eigen::VectorXd& coefficients) {
  return row.of_baseline() && coefficients.size() > 0 &&
         coefficients.cwiseAbs().maxCoeff() > row.part->most;
}

bool is_taken_up(const Trial& trial, const Limits& limits) {
  return trial.cause.form->transform == nullptr && trial.size >= limits.half &&
         trial.change < limits.alike() * trial.size;
}

bool goes_before(const Trial& part, const Trial& cause, const Limits& limits) {
  return part.cause.row != nullptr && part.cause.row->of_baseline() && !part.cause.form->extends &&
         part.gain > cause.gain - limits.named_gain && admissible(part, limits);
}

void judge_small_again(const Frame& frame, const Limits& limits, Selection& s) {
  for (std::size_t i = 0; i < s.accepted.size(); ++i) {
    Accepted& a = s.accepted[i];
    if (a.material || a.trial.cause.row->of_baseline()) continue;
    a.trial.net_gain += a.trial.gain - a.first_gain;
    a.first_gain = a.trial.gain;
    a.trial.size = share_of_torque(frame, s.final.fit.model, s.final.reference, i);
    a.material = is_material(a.trial, limits);
  }
}

Result<Findings> nearest_model(const Frame& frame, const Limits& limits,
                               const std::function<void(double, std::string_view)>& progress) {
  auto baseline = fit_baseline(frame);
  if (!baseline) return baseline;
  Selection s;
  s.baseline = *baseline;
  s.final = std::move(*baseline);
  return search(frame, limits, s, progress, limits.tenth).map([&] { return std::move(s.final); });
}

Result<Selection> select_causes(const Frame& frame, const Limits& limits,
                                const std::function<void(double, std::string_view)>& progress,
                                const Selection* from) {
  auto baseline = fit_baseline(frame);
  if (!baseline) return tl::unexpected(baseline.error());
  Selection s;
  s.baseline = *baseline;
  s.final = std::move(*baseline);
  if (from != nullptr) {
    const auto taken = take_causes(frame, *from, s);
    if (!taken) return tl::unexpected(taken.error());
  }
  const auto found = search(frame, limits, s, progress, 0.0);
  if (!found) return tl::unexpected(found.error());
  const auto exchanged = exchange_for_better(frame, limits, s);
  if (!exchanged) return tl::unexpected(exchanged.error());
  const auto cleared = take_out_needless(frame, limits, s);
  if (!cleared) return tl::unexpected(cleared.error());
  const auto plain = take_plain_forms(frame, limits, s);
  if (!plain) return tl::unexpected(plain.error());
  judge_small_again(frame, limits, s);
  return s;
}

Result<void> settle_baseline(const Frame& frame, Selection& s) {
  put_immaterial_first(s);
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

Result<void> leave_out(const Frame& frame, Selection& s, std::size_t cause,
                       std::string_view because) {
  auto fit = reduced(frame, s.final, s.immaterial.size() + cause, kRefreshSteps);
  if (!fit) return tl::unexpected(fit.error());
  s.final.fit = std::move(*fit);
  s.accepted[cause].withdrawn_because = because;
  s.withdrawn.insert(s.withdrawn.begin(), std::move(s.accepted[cause]));
  s.accepted.erase(s.accepted.begin() + static_cast<long>(cause));
  return fit_again(frame, s);
}

void locate_misfit(const Frame& frame, const Limits& limits, Selection& s) {
  s.before = locate(frame, s.baseline);
  s.after = s.accepted.empty() ? locate_anything(frame, s.final) : locate(frame, s.final);
  s.remainder = std::ranges::any_of(s.after, [&](const auto& c) { return is_left(c, limits); }) ||
                is_fitted_beyond_noise(frame, s.final, limits);
}

}  // namespace flexspline::studies
