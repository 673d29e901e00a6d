#include "diagnosis/needless.hpp"

#include <algorithm>
#include <numeric>
#include <optional>

#include "diagnosis/explanation.hpp"

namespace flexspline::studies {
namespace {

constexpr int kRefreshSteps = 8;

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

/// What each accepted cause is worth beside the others.
struct Worth {
  std::vector<ModelFit> without;  ///< the model without it
  std::vector<double> loss;       ///< rise of the chi square
};

Result<Worth> worth_of_each(const Frame& frame, Selection& s) {
  Worth worth;
  for (std::size_t i = 0; i < s.accepted.size(); ++i) {
    auto fit = reduced(frame, s.final, i, kRefreshSteps);
    if (!fit) return tl::unexpected(fit.error());
    worth.loss.push_back(chi_square_rise(frame, s.final, *fit));
    s.accepted[i].trial.gain = worth.loss.back();
    worth.without.push_back(std::move(*fit));
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

// The least first. One in the shadow of a larger one stays if nothing is left with it, and
// something without it: no error of form is as orderly.
Needless needless(const Frame& frame, const Limits& limits, const Selection& s,
                  const Worth& worth) {
  std::vector<std::size_t> order(worth.loss.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t i) { return worth.loss[i]; });
  if (!(worth.loss[order.front()] > limits.net_gain)) {
    return {order.front(), "the others explain it as well"};
  }
  const bool complete = !leaves_something(frame, s.final, s.final.fit, limits);
  for (std::size_t i : order) {
    if (!in_the_shadow(s, i, worth.loss, limits)) return {};
    if (complete && leaves_something(frame, s.final, worth.without[i], limits)) continue;
    return {i, "what it explains is no more than the form of a larger one may miss"};
  }
  return {};
}

}  // namespace

Result<void> take_out_needless(const Frame& frame, const Limits& limits, Selection& s) {
  while (s.accepted.size() > 1) {
    auto worth = worth_of_each(frame, s);
    if (!worth) return tl::unexpected(worth.error());
    const auto [cause, because] = needless(frame, limits, s, *worth);
    if (!cause) return {};
    s.final.fit = std::move(worth->without[*cause]);
    s.accepted[*cause].withdrawn_because = because;
    if (s.accepted[*cause].material) s.withdrawn.push_back(std::move(s.accepted[*cause]));
    s.accepted.erase(s.accepted.begin() + static_cast<long>(*cause));
    const auto again = refresh(frame, s.final, kRefreshSteps);
    if (!again) return again;
  }
  return {};
}

}  // namespace flexspline::studies
