#include "diagnosis/needless.hpp"

#include <algorithm>
#include <optional>

#include "flexspline/core/in_parallel.hpp"

namespace flexspline::studies {
namespace {

constexpr int kRefreshSteps = 8;
constexpr int kRefineSteps = 12;

double chi_square_rise(const Frame& frame, const Findings& findings, const ModelFit& fit) {
  return chi_square(frame, findings, fit) - chi_square(frame, findings, findings.fit);
}

bool stands_for(const Accepted& a, const Accepted& b) {
  return std::ranges::any_of(a.rivals,
                             [&](const Trial& t) { return t.cause.row == b.trial.cause.row; });
}

// Too small to be named, it would go into the baseline and take the place of the large one there.
bool usurps(const Accepted& small, const Accepted& large) {
  return !small.material && (stands_for(small, large) || stands_for(large, small));
}

std::optional<std::size_t> usurper_of(const Selection& s, std::size_t large) {
  for (std::size_t k = 0; k < s.accepted.size(); ++k) {
    if (s.accepted[large].material && usurps(s.accepted[k], s.accepted[large])) return k;
  }
  return std::nullopt;
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
    s.accepted[i].trial.gain = worth.loss.back();
    worth.without.push_back(std::move(*fits[i]));
  }
  return worth;
}

// No model is worse than one that it contains: where it seems so, its fit was caught in a local
// optimum, and starts again from the smaller one's. The cause moves to the end of the model. True
// where that helped.
bool fitted_better(const Frame& frame, const Limits& limits, Selection& s, const Worth& worth) {
  for (std::size_t i = 0; i < s.accepted.size(); ++i) {
    if (!(worth.loss[i] < 0.0)) continue;
    Findings smaller = s.final;
    smaller.fit = worth.without[i];
    auto again = extended(frame, smaller, s.accepted[i].trial.cause, kRefineSteps);
    if (!again) continue;
    if (!(chi_square_rise(frame, s.final, *again) < worth.loss[i] - limits.gain)) continue;
    s.final.fit = std::move(*again);
    const auto at = s.accepted.begin() + static_cast<long>(i);
    std::rotate(at, at + 1, s.accepted.end());
    return true;
  }
  return false;
}

/// The cause that may go, and why; none where each is needed.
struct Needless {
  std::optional<std::size_t> cause;
  std::string_view because;
};

Needless needless(const Limits& limits, const Selection& s, const Worth& worth) {
  for (std::size_t i = 0; i < s.accepted.size(); ++i) {
    if (is_no_part(*s.accepted[i].trial.cause.row, s.final.fit.model.coefficients[i])) {
      return {i, "it is more than a part of the baseline"};
    }
  }
  const auto least =
      static_cast<std::size_t>(std::ranges::min_element(worth.loss) - worth.loss.begin());
  if (worth.loss[least] > limits.gain) return {};
  return {usurper_of(s, least).value_or(least), "the others explain it as well"};
}

}  // namespace

Result<void> take_out_needless(const Frame& frame, const Limits& limits, Selection& s) {
  std::size_t chances = s.accepted.size();
  while (s.accepted.size() > 1) {
    auto worth = worth_of_each(frame, s, limits.threads);
    if (!worth) return tl::unexpected(worth.error());
    if (chances > 0 && fitted_better(frame, limits, s, *worth)) {
      --chances;
      continue;
    }
    const auto [cause, because] = needless(limits, s, *worth);
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
