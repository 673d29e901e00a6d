#include "ode_fit/noise.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "ode_fit/weighted_shooting.hpp"

namespace flexspline::estimators {
namespace {

constexpr double kNormalMad = 1.4826;  // standard deviation over median absolute deviation
constexpr double kLeast = 1e-12;       // of the sigma given: below it there is nothing to weigh by

struct OutputResiduals {
  std::vector<TimedSeries> series;  // an experiment each

  std::vector<double> pooled() const {
    std::vector<double> all;
    for (const auto& one : series) all.insert(all.end(), one.value.begin(), one.value.end());
    return all;
  }
};

// Residuals by output, over the sigmas that the layout has at present.
Result<std::vector<OutputResiduals>> residuals_of(const OdeLayout& layout,
                                                  std::span<const double> q, double tolerance) {
  const ShootingProblem shots(layout, tolerance, 1);
  std::vector<OutputResiduals> result;
  for (std::size_t b = 0; b < shots.blocks(); ++b) {
    const auto& experiment = shots.experiment(b);
    std::vector<double> residual(shots.residuals(b));
    auto done = shots.evaluate(b, q, residual, {});
    if (!done) return tl::unexpected(std::move(done).error());
    result.resize(std::max(result.size(), experiment.outputs()));
    for (std::size_t o = 0; o < experiment.outputs(); ++o) {
      auto rows = rows_of(experiment, o);
      TimedSeries series{std::move(rows.time), {}};
      for (const std::size_t row : rows.row) series.value.push_back(residual[row]);
      result[o].series.push_back(std::move(series));
    }
  }
  return result;
}

double spread_of(std::vector<double> values, const RobustLoss& loss) {
  if (loss.squared()) {
    double sum = 0.0;
    for (double v : values) sum += v * v;
    return std::sqrt(sum / static_cast<double>(values.size()));
  }
  for (double& v : values) v = std::abs(v);
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return kNormalMad * *middle;
}

ColouredNoise noise_of(const OutputResiduals& output, double growth, const RobustLoss& loss,
                       Weighting weighting) {
  ColouredNoise noise;
  if (weighting == Weighting::coloured) {
    noise = estimate_noise(output.series);
  } else {
    noise.sigma = spread_of(output.pooled(), loss);
  }
  noise.sigma *= growth;
  return noise;
}

// sigma takes the size of the noise; the filter has the correlation of unit variance.
void apply(OdeLayout& layout, std::size_t output, const ColouredNoise& noise, bool coloured) {
  for (auto& experiment : layout.experiments) {
    if (output >= experiment.outputs()) continue;
    experiment.source.sigma[output] *= noise.sigma;
    if (!coloured) continue;
    const auto rows = rows_of(experiment, output);
    if (output == 0) experiment.whitening.clear();
    experiment.whitening.emplace_back(ColouredNoise{1.0, noise.share, noise.time}, rows.time);
  }
}

}  // namespace

Result<double> weigh_anew(OdeLayout& layout, std::span<const double> q, std::size_t free,
                          const OdeFitSettings& settings, std::vector<OutputNoise>& noise) {
  const auto outputs = residuals_of(layout, q, settings.integration_tolerance);
  if (!outputs) return tl::unexpected(outputs.error());
  double rows = 0.0;
  for (const auto& one : *outputs) rows += static_cast<double>(one.pooled().size());
  const double growth = std::sqrt(rows / std::max(1.0, rows - static_cast<double>(free)));
  noise.resize(outputs->size());
  double change = 0.0;
  for (std::size_t o = 0; o < outputs->size(); ++o) {
    if ((*outputs)[o].pooled().empty()) {
      apply(layout, o, {}, settings.weighting == Weighting::coloured);
      continue;
    }
    const auto found = noise_of((*outputs)[o], growth, layout.loss, settings.weighting);
    if (!(found.sigma * noise[o].factor > kLeast)) {
      return failure(ErrorCode::numerics,
                     fmt::format("output {} leaves nothing to estimate its noise from", o + 1),
                     "weigh by sigmas that are given");
    }
    change =
        std::max({change, std::abs(std::log(found.sigma)), std::abs(found.share - noise[o].share),
                  found.time > 0.0 && noise[o].time > 0.0
                      ? found.share * std::abs(std::log(found.time / noise[o].time))
                      : 0.0});
    apply(layout, o, found, settings.weighting == Weighting::coloured);
    noise[o] = {noise[o].factor * found.sigma, found.share, found.time};
  }
  return change;
}

}  // namespace flexspline::estimators
