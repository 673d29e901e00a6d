#include "diagnosis/search/needless.hpp"

#include <algorithm>
#include <numeric>
#include <optional>

#include "diagnosis/search/explanation.hpp"
#include "diagnosis/search/form_error.hpp"
#include "flexspline/core/in_parallel.hpp"

namespace flexspline::studies {
namespace {

double chi_square_rise(const Frame& frame, const Findings& findings, const ModelFit& fit) {
  return chi_square(frame, findings, fit) - chi_square(frame, findings, findings.fit);
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

// Whether what a small cause explains may be no more than the form of a larger one of its equation.
bool hides(const Frame& frame, const Selection& s, std::size_t large, std::size_t small,
           const std::vector<double>& loss, const Limits& limits) {
  const Accepted& a = s.accepted[small];
  const Accepted& b = s.accepted[large];
  if (loss[large] <= loss[small] || !share_equation(a, b)) return false;
  if (!stands_for(a, b) && !stands_for(b, a)) return loss[small] < limits.shadow * loss[large];
  const double share = loss[small] / std::max(a.first_gain, b.first_gain);
  if (share < limits.tenth) return true;
  return share < 2.0 * limits.tenth &&
         share_beyond_form(frame, s.final, small, large) < limits.tenth;
}

// The larger cause that hides another.
std::optional<std::size_t> shadow_on(const Frame& frame, const Selection& s, std::size_t i,
                                     const std::vector<double>& loss, const Limits& limits) {
  for (std::size_t k = 0; k < s.accepted.size(); ++k) {
    if (hides(frame, s, k, i, loss, limits)) return k;
  }
  return std::nullopt;
}

// What grew after it was accepted, as something came to counteract it.
bool is_mostly_taken_back(const Trial& trial, const Limits& limits) {
  return !trial.cause.row->of_baseline() && trial.cause.form->transform == nullptr &&
         trial.size >= limits.half && trial.change < limits.half * trial.size;
}

/// What each accepted cause is worth beside the others.
struct Worth {
  std::vector<ModelFit> without;  ///< the model without it
  std::vector<double> loss;       ///< rise of the chi square
};

Result<Worth> worth_of_each(const Frame& frame, Selection& s, unsigned threads) {
  std::vector<Result<ModelFit>> fits(s.accepted.size());
  in_parallel(fits.size(), threads_for(threads),
              [&](std::size_t i) { fits[i] = reduced(frame, s.final, i, kRefreshSteps); });
  Worth worth;
  for (std::size_t i = 0; i < s.accepted.size(); ++i) {
    if (!fits[i]) return tl::unexpected(fits[i].error());
    worth.loss.push_back(chi_square_rise(frame, s.final, *fits[i]));
    Trial& trial = s.accepted[i].trial;
    trial.gain = worth.loss.back();
    trial.size = share_of_torque(frame, s.final.fit.model, s.final.reference, i);
    trial.change = change_of_torque(frame, *trial.cause.form, s.final.fit, *fits[i]);
    worth.without.push_back(std::move(*fits[i]));
  }
  return worth;
}

bool leaves_something(const Frame& frame, Findings findings, const ModelFit& fit,
                      const Limits& limits) {
  findings.fit = fit;
  return std::ranges::any_of(locate(frame, findings),
                             [&](const CoordinateScore& c) { return is_left(c, limits); });
}

/// The cause that may go, and why; none where each is needed.
struct Needless {
  std::optional<std::size_t> cause;
  std::string_view because;
};

// One in a shadow stays where nothing is left with it, most of its worth no error in the form of
// the larger one explains, and something is left without it or its worth is that of a name.
bool stays(const Frame& frame, const Limits& limits, const Selection& s, const Worth& worth,
           std::size_t cause, std::size_t large) {
  return share_beyond_form(frame, s.final, cause, large) > limits.half &&
         (worth.loss[cause] > limits.named_gain ||
          leaves_something(frame, s.final, worth.without[cause], limits));
}

// The least first.
Needless needless(const Frame& frame, const Limits& limits, const Selection& s,
                  const Worth& worth) {
  for (std::size_t i = 0; i < s.accepted.size(); ++i) {
    const Trial& trial = s.accepted[i].trial;
    if (is_no_part(*trial.cause.row, s.final.fit.model.coefficients[i])) {
      return {i, "it is more than a part of the baseline"};
    }
    if (is_mostly_taken_back(trial, limits)) {
      return {i, "the baseline and the others take most of it back"};
    }
  }
  std::vector<std::size_t> order(worth.loss.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t i) { return worth.loss[i]; });
  if (!(worth.loss[order.front()] > limits.gain)) {
    return {order.front(), "the others explain it as well"};
  }
  const bool complete = !leaves_something(frame, s.final, s.final.fit, limits);
  for (std::size_t i : order) {
    if (s.accepted[i].trial.cause.row->of_baseline()) continue;
    const auto large = shadow_on(frame, s, i, worth.loss, limits);
    if (!large) continue;
    if (complete && stays(frame, limits, s, worth, i, *large)) continue;
    return {i, "what it explains is no more than the form of a larger one may miss"};
  }
  return {};
}

}  // namespace

Result<void> take_out_needless(const Frame& frame, const Limits& limits, Selection& s) {
  while (!s.accepted.empty()) {
    auto worth = worth_of_each(frame, s, limits.threads);
    if (!worth) return tl::unexpected(worth.error());
    if (s.accepted.size() == 1) return {};
    const auto [cause, because] = needless(frame, limits, s, *worth);
    if (!cause) return {};
    s.final.fit = std::move(worth->without[*cause]);
    s.accepted[*cause].withdrawn_because = because;
    s.redundant.push_back(s.accepted[*cause].trial.cause.row);
    if (s.accepted[*cause].material) s.withdrawn.push_back(std::move(s.accepted[*cause]));
    s.accepted.erase(s.accepted.begin() + static_cast<long>(*cause));
    const auto again = refresh(frame, s.final, kRefreshSteps);
    if (!again) return again;
  }
  return {};
}

}  // namespace flexspline::studies
