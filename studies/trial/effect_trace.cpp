#include "trial/effect_trace.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "diagnosis/search/search.hpp"

namespace flexspline::studies {
namespace {

constexpr Eigen::Index kMostRows = 16000;
constexpr double kMost = 0.99;  // quantile that counts as the largest: single samples may err

/// The baseline on a set of recordings.
struct BaselineFit {
  Frame frame;
  Findings findings;
};

Result<BaselineFit> baseline_of(const RecordingSet& recordings) {
  auto frame = make_frame(recordings, kMostRows);
  if (!frame) return tl::unexpected(frame.error());
  auto findings = fit_baseline(*frame);
  if (!findings) return tl::unexpected(findings.error());
  return BaselineFit{*std::move(frame), *std::move(findings)};
}

const Segment* same_recording(const Segment& one, const Frame& other) {
  const auto found = std::ranges::find(other.segments, one.id, &Segment::id);
  return found != other.segments.end() && found->count == one.count ? &*found : nullptr;
}

double quantile(std::vector<double> values, double share) {
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::ranges::nth_element(values, at);
  return *at;
}

// Of one equation; nothing where a recording has no counterpart.
EffectTrace trace_in(Equation equation, const BaselineFit& with, const BaselineFit& without) {
  const std::size_t e = index_of(equation);
  const EquationNoise& noise = without.findings.noise[e];
  std::vector<double> size;
  double chi_square = 0.0;
  for (std::size_t s = 0; s < without.frame.segments.size(); ++s) {
    const Segment& b = without.frame.segments[s];
    const Segment* const a = same_recording(b, with.frame);
    if (a == nullptr) return {};
    const Eigen::ArrayXd judged = with.frame.rows_of(equation).segment(a->first, a->count) *
                                  without.frame.rows_of(equation).segment(b.first, b.count);
    const Eigen::ArrayXd difference =
        judged * (with.findings.fit.residual[e].segment(a->first, a->count) -
                  without.findings.fit.residual[e].segment(b.first, b.count));
    chi_square += (difference / noise.level[s]).square().sum() / noise.colour;
    for (Eigen::Index k = 0; k < b.count; ++k) {
      if (judged[k] > 0.0) size.push_back(std::abs(difference[k]));
    }
  }
  if (size.empty()) return {};
  return {{},
          quantile(std::move(size), kMost) / without.frame.largest_torque(equation),
          std::sqrt(chi_square)};
}

EffectTrace trace_between(const BaselineFit& with, const BaselineFit& without) {
  EffectTrace largest{{}, 0.0, 0.0};
  for (const Equation equation : without.frame.equations) {
    if (!with.frame.has(equation)) return {};
    const EffectTrace trace = trace_in(equation, with, without);
    if (!std::isfinite(trace.share)) return {};
    largest.share = std::max(largest.share, trace.share);
    largest.sigma = std::max(largest.sigma, trace.sigma);
  }
  return largest;
}

}  // namespace

Result<std::vector<EffectTrace>> traces_of(const ConcealPlan& plan,
                                           const RecordingSet& recordings) {
  std::vector<EffectTrace> traces;
  if (plan.effects.empty()) return traces;
  const auto with = baseline_of(recordings);
  if (!with) return tl::unexpected(with.error());
  for (std::size_t k = 0; k < plan.effects.size(); ++k) {
    ConcealPlan without = plan;
    without.effects.erase(without.effects.begin() + static_cast<std::ptrdiff_t>(k));
    const auto control = conceal(without);
    if (!control) return tl::unexpected(control.error());
    const auto fit = baseline_of(control->recordings);
    if (!fit) return tl::unexpected(fit.error());
    traces.push_back(trace_between(*with, *fit));
    traces.back().effect = plan.effects[k].id;
  }
  return traces;
}

}  // namespace flexspline::studies
