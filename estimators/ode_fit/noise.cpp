#include "ode_fit/noise.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "ode_fit/weighted_shooting.hpp"
#include "uncertainty/noise_mixture.hpp"

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

std::vector<Eigen::Index> free_columns(const std::vector<bool>& bound_active) {
  std::vector<Eigen::Index> free;
  for (std::size_t k = 0; k < bound_active.size(); ++k) {
    if (!bound_active[k]) free.push_back(static_cast<Eigen::Index>(k));
  }
  return free;
}

// Columns of all outputs to length one; what their lengths were.
Eigen::VectorXd scale_slopes(std::vector<OutputResiduals>& outputs, Eigen::Index columns) {
  Eigen::VectorXd squares = Eigen::VectorXd::Zero(columns);
  for (const auto& output : outputs) {
    for (const auto& one : output.series) squares += one.slope.colwise().squaredNorm();
  }
  const Eigen::VectorXd length = (squares.array() > 0.0).select(squares.cwiseSqrt(), 1.0);
  for (auto& output : outputs) {
    for (auto& one : output.series) one.slope = one.slope * length.cwiseInverse().asDiagonal();
  }
  return length;
}

// Residuals by output with their slopes by what is free, over the sigmas that the layout has.
Result<std::vector<OutputResiduals>> residuals_of(const OdeLayout& layout,
                                                  std::span<const double> q,
                                                  const std::vector<Eigen::Index>& free,
                                                  double tolerance) {
  const ShootingProblem shots(layout, tolerance, 1);
  std::vector<OutputResiduals> result;
  for (std::size_t b = 0; b < shots.blocks(); ++b) {
    const auto& experiment = shots.experiment(b);
    std::vector<double> residual(shots.residuals(b));
    RowMajorMatrix slopes(static_cast<Eigen::Index>(residual.size()),
                          static_cast<Eigen::Index>(q.size()));
    auto done =
        shots.evaluate(b, q, residual, {slopes.data(), static_cast<std::size_t>(slopes.size())});
    if (!done) return tl::unexpected(std::move(done).error());
    result.resize(std::max(result.size(), experiment.outputs()));
    for (std::size_t o = 0; o < experiment.outputs(); ++o) {
      auto rows = rows_of(experiment, o);
      TimedSeries series{std::move(rows.time), {}, {}};
      const std::vector<Eigen::Index> places(rows.row.begin(), rows.row.end());
      series.slope = slopes(places, free);
      for (const std::size_t row : rows.row) series.value.push_back(residual[row]);
      result[o].series.push_back(std::move(series));
    }
  }
  return result;
}

// What all other outputs say of the parameters, with the noise they have at present.
OtherInformation others_than(std::size_t output, const std::vector<OutputResiduals>& outputs,
                             const std::vector<OutputNoise>& noise, Eigen::Index columns) {
  OtherInformation sum{Eigen::MatrixXd::Zero(columns, columns), Eigen::VectorXd::Zero(columns)};
  for (std::size_t o = 0; o < outputs.size(); ++o) {
    if (o == output || outputs[o].series.empty()) continue;
    const auto one = information_of(outputs[o].series, {1.0, noise[o].share, noise[o].time});
    sum.information += one.information;
    sum.gradient += one.gradient;
  }
  return sum;
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

double change_of(const OutputNoise& before, const ColouredNoise& now) {
  const double time = now.time > 0.0 && before.time > 0.0
                          ? now.share * std::abs(std::log(now.time / before.time))
                          : 0.0;
  return std::max({std::abs(std::log(now.sigma)), std::abs(now.share - before.share), time});
}

}  // namespace

Result<double> weigh_anew(OdeLayout& layout, std::span<const double> q,
                          const std::vector<bool>& bound_active, const OdeFitSettings& settings,
                          std::vector<OutputNoise>& noise) {
  const auto free = free_columns(bound_active);
  const auto columns = static_cast<Eigen::Index>(free.size());
  auto outputs = residuals_of(layout, q, free, settings.integration_tolerance);
  if (!outputs) return tl::unexpected(outputs.error());
  scale_slopes(*outputs, columns);
  double rows = 0.0;
  for (const auto& one : *outputs) rows += static_cast<double>(one.pooled().size());
  const double growth = std::sqrt(rows / std::max(1.0, rows - static_cast<double>(free.size())));
  const bool coloured = settings.weighting == Weighting::coloured;
  const auto before = noise;
  double change = 0.0;
  for (std::size_t o = 0; o < outputs->size(); ++o) {
    const auto& output = (*outputs)[o];
    ColouredNoise found;
    if (!output.pooled().empty()) {
      found = coloured ? estimate_noise(output.series, others_than(o, *outputs, before, columns))
                       : ColouredNoise{growth * spread_of(output.pooled(), layout.loss), 0.0, 0.0};
    }
    if (!(found.sigma * noise[o].factor > kLeast)) {
      return failure(ErrorCode::numerics,
                     fmt::format("output {} leaves nothing to estimate its noise from", o + 1),
                     "weigh by sigmas that are given");
    }
    change = std::max(change, change_of(noise[o], found));
    apply(layout, o, found, coloured);
    noise[o] = {noise[o].factor * found.sigma, found.share, found.time};
  }
  return change;
}

Result<void> widen_for_noise(const OdeLayout& layout, std::span<const double> q,
                             const std::vector<bool>& bound_active, double tolerance,
                             const std::vector<OutputNoise>& noise, OdeFit& fit) {
  const auto free = free_columns(bound_active);
  const bool coloured =
      std::ranges::any_of(noise, [](const OutputNoise& one) { return one.share > 0.0; });
  if (free.empty() || !coloured || !(fit.degrees_of_freedom > 0.0)) return {};
  auto outputs = residuals_of(layout, q, free, tolerance);
  if (!outputs) return tl::unexpected(outputs.error());
  const Eigen::VectorXd length = scale_slopes(*outputs, static_cast<Eigen::Index>(free.size()));
  std::vector<std::vector<TimedSeries>> series;
  std::vector<ColouredNoise> at;
  for (std::size_t o = 0; o < outputs->size(); ++o) {
    if ((*outputs)[o].pooled().empty()) continue;
    series.push_back((*outputs)[o].series);
    at.push_back({1.0, noise[o].share, noise[o].time});
  }
  const NoiseMixture mixture = over_noise(series, at, fit.degrees_of_freedom);
  for (std::size_t i = 0; i < free.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    ParameterEstimate& one = fit.parameters[static_cast<std::size_t>(free[i])];
    const double std = mixture.std[k] / length[k];
    const double growth = std / one.std;
    one.std = std;
    one.ci95_lower = one.value + mixture.lower[k] / length[k];
    one.ci95_upper = one.value + mixture.upper[k] / length[k];
    fit.covariance.row(free[i]) *= growth;
    fit.covariance.col(free[i]) *= growth;
  }
  return {};
}

}  // namespace flexspline::estimators
