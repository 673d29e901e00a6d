#include "diagnosis/search/plain_form.hpp"

#include <algorithm>

namespace flexspline::studies {
namespace {

constexpr int kSteps = 12;

// The cause without the shape that its form has beyond the one before it.
ActiveCause plain(ActiveCause cause) {
  --cause.form;
  cause.shape.pop_back();
  return cause;
}

// The model with the plain form of a cause, which moves to its end.
Result<ModelFit> with_plain_form(const Frame& frame, const Findings& findings, std::size_t i) {
  Findings others = findings;
  auto without = reduced(frame, findings, i, kSteps);
  if (!without) return without;
  others.fit = std::move(*without);
  return extended(frame, others, plain(findings.fit.model.causes[i]), kSteps);
}

}  // namespace

Result<void> take_plain_forms(const Frame& frame, const Limits& limits, Selection& s) {
  for (std::size_t i = 0; i < s.accepted.size(); ++i) {
    if (!s.accepted[i].trial.cause.form->extends) continue;
    auto fit = with_plain_form(frame, s.final, i);
    if (!fit) return tl::unexpected(fit.error());
    Findings simpler = s.final;
    simpler.fit = std::move(*fit);
    if (chi_square(frame, simpler, simpler.fit) - chi_square(frame, s.final, s.final.fit) >
        limits.gain)
      continue;
    s.final = std::move(simpler);
    s.accepted[i].trial.cause = s.final.fit.model.causes.back();
    const auto at = s.accepted.begin() + static_cast<std::ptrdiff_t>(i);
    std::rotate(at, at + 1, s.accepted.end());
    --i;
  }
  return {};
}

}  // namespace flexspline::studies
