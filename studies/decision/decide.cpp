#include "decision/decide.hpp"

namespace flexspline::studies::decision {
namespace {

constexpr int kFirstPasses = 6;
constexpr int kNoisePasses = 2;

void say(const DiagnosisProgress& progress, double share, std::string_view stage) {
  if (progress) progress(share, stage);
}

// Noise: from white about running parabolas to what the model's own residual says.
Fit settled(Bench& bench, Fit fit) {
  for (int pass = 0; pass < kNoisePasses; ++pass) fit = with_fitted_noise(bench, std::move(fit));
  return fit;
}

// Causes, with the noise that is left with them.
void name(Decision& d, const Calibration& calibration) {
  d.fit = search(d.bench, d.baseline, calibration);
  if (!d.fit.state.causes.empty()) d.fit = with_fitted_noise(d.bench, std::move(d.fit));
}

// Names that are too small to matter, or whose class is not sure enough, go.
bool drop_unsure(const Bench& bench, const Calibration& calibration, Fit& fit,
                 std::vector<Named>& named) {
  const Named* least = nullptr;
  for (const Named& one : named) {
    const bool stands =
        one.size >= calibration.interest && one.probability >= calibration.probability;
    if (!stands && (least == nullptr || one.gain < least->gain)) least = &one;
  }
  if (least == nullptr) return false;
  fit = without(bench, fit, least->cause);
  named = name_causes(bench, fit, calibration);
  return true;
}

}  // namespace

Decision decide(const Frame& frame, const Calibration& calibration, unsigned threads,
                const DiagnosisProgress& progress) {
  Decision d;
  say(progress, 0.05, "noise");
  d.bench = bench_of(frame, threads);
  d.baseline = fit_state(d.bench, first_state(frame), {}, kFirstPasses);
  d.baseline = settled(d.bench, std::move(d.baseline));
  prune(d.bench, d.baseline);

  say(progress, 0.25, "locating");
  d.located = locate(d.bench, d.baseline);

  say(progress, 0.35, "naming");
  name(d, calibration);
  d.burst = find_burst(d.bench, d.fit, calibration);
  if (d.burst) {
    mask(d.bench, d.burst->first, d.burst->count);
    d.baseline = settled(d.bench, refit(d.bench, d.baseline, d.baseline.state, 2));
    name(d, calibration);
  }

  say(progress, 0.75, "telling causes apart");
  d.named = name_causes(d.bench, d.fit, calibration);
  while (drop_unsure(d.bench, calibration, d.fit, d.named)) continue;
  d.tried = screen(d.bench, d.fit);

  say(progress, 0.9, "what is left");
  d.remains = locate(d.bench, d.fit);
  d.left = what_is_left(d.bench, d.fit, calibration);
  return d;
}

}  // namespace flexspline::studies::decision
