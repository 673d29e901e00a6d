#include "uncertainty/bootstrap.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <fmt/format.h>

namespace flexspline::estimators {
namespace {

constexpr double kMostCorrelation = 0.97;

// The problem with other noise: residuals less a shift.
class Shifted final : public LeastSquaresProblem {
 public:
  Shifted(const LeastSquaresProblem& problem, Eigen::VectorXd shift)
      : problem_(problem), shift_(std::move(shift)) {
    Eigen::Index row = 0;
    for (std::size_t b = 0; b < problem.blocks(); ++b) {
      first_.push_back(row);
      row += static_cast<Eigen::Index>(problem.residuals(b));
    }
  }

  std::size_t blocks() const override { return problem_.blocks(); }
  std::size_t residuals(std::size_t block) const override { return problem_.residuals(block); }
  Result<void> evaluate(std::size_t block, std::span<const double> p, std::span<double> residual,
                        std::span<double> jacobian) const override {
    auto done = problem_.evaluate(block, p, residual, jacobian);
    if (!done) return done;
    for (std::size_t k = 0; k < residual.size(); ++k) {
      residual[k] -= shift_[first_[block] + static_cast<Eigen::Index>(k)];
    }
    return {};
  }

 private:
  const LeastSquaresProblem& problem_;
  Eigen::VectorXd shift_;
  std::vector<Eigen::Index> first_;
};

std::vector<NoiseSeries> blocks_as_series(const LeastSquaresProblem& problem) {
  std::vector<NoiseSeries> list;
  std::size_t row = 0;
  for (std::size_t b = 0; b < problem.blocks(); ++b) {
    list.emplace_back();
    for (std::size_t k = 0; k < problem.residuals(b); ++k) list.back().push_back(row++);
  }
  return list;
}

std::vector<double> values(const Eigen::VectorXd& residual, const NoiseSeries& series) {
  std::vector<double> list;
  for (const std::size_t row : series) list.push_back(residual[static_cast<Eigen::Index>(row)]);
  return list;
}

// The noise that a replicate is made with: about zero, with the share that the fit took put back.
struct Source {
  std::vector<NoiseSeries> series;
  std::vector<std::vector<double>> noise;
  std::vector<double> block_length;
  double sigma = 1.0;
};

Source source_of(const LeastSquaresProblem& problem, const Eigen::VectorXd& residual,
                 double freedom, const BootstrapSettings& settings) {
  Source source;
  source.series = settings.series.empty() ? blocks_as_series(problem) : settings.series;
  const double growth = std::sqrt(static_cast<double>(residual.size()) / freedom);
  if (!settings.noise_known) source.sigma = residual.norm() / std::sqrt(freedom);
  for (const auto& series : source.series) {
    auto noise = values(residual, series);
    double mean = 0.0;
    for (double e : noise) mean += e / static_cast<double>(noise.size());
    for (double& e : noise) e = growth * (e - mean);
    const double own = stationary_block_length(noise);
    source.block_length.push_back(settings.block_length > 0.0 ? settings.block_length : own);
    source.noise.push_back(std::move(noise));
  }
  return source;
}

void draw_blocks(const std::vector<double>& noise, double length, std::mt19937_64& engine,
                 const NoiseSeries& rows, Eigen::VectorXd& drawn) {
  if (noise.empty()) return;
  std::uniform_int_distribution<std::size_t> anywhere(0, noise.size() - 1);
  std::bernoulli_distribution ends(1.0 / std::max(1.0, length));
  std::size_t at = anywhere(engine);
  for (const std::size_t row : rows) {
    drawn[static_cast<Eigen::Index>(row)] = noise[at];
    at = ends(engine) ? anywhere(engine) : (at + 1) % noise.size();
  }
}

Eigen::VectorXd drawn_noise(const Source& source, Eigen::Index rows, std::size_t replicate,
                            const BootstrapSettings& settings) {
  std::seed_seq seeds{static_cast<std::uint32_t>(settings.seed),
                      static_cast<std::uint32_t>(settings.seed >> 32),
                      static_cast<std::uint32_t>(replicate)};
  std::mt19937_64 engine(seeds);
  std::normal_distribution<double> normal(0.0, source.sigma);
  Eigen::VectorXd drawn = Eigen::VectorXd::Zero(rows);
  if (settings.resampling == Resampling::parametric) {
    for (double& e : drawn) e = normal(engine);
    return drawn;
  }
  for (std::size_t s = 0; s < source.series.size(); ++s) {
    draw_blocks(source.noise[s], source.block_length[s], engine, source.series[s], drawn);
  }
  return drawn;
}

double percentile(std::vector<double> sorted, double share) {
  std::ranges::sort(sorted);
  const double place = share * static_cast<double>(sorted.size() - 1);
  const auto low = static_cast<std::size_t>(place);
  const std::size_t high = std::min(low + 1, sorted.size() - 1);
  return sorted[low] + (place - static_cast<double>(low)) * (sorted[high] - sorted[low]);
}

void summarise(Bootstrap& result, double level) {
  const auto& all = result.replicate;
  const Eigen::MatrixXd about = all.rowwise() - all.colwise().mean();
  result.covariance =
      about.transpose() * about / static_cast<double>(std::max<Eigen::Index>(1, all.rows() - 1));
  for (const auto& column : all.colwise()) {
    const std::vector<double> values(column.begin(), column.end());
    result.lower.push_back(percentile(values, 0.5 * (1.0 - level)));
    result.upper.push_back(percentile(values, 0.5 * (1.0 + level)));
  }
}

}  // namespace

double stationary_block_length(std::span<const double> series) {
  double cross = 0.0;
  double total = 0.0;
  for (std::size_t i = 0; i < series.size(); ++i) {
    total += series[i] * series[i];
    if (i > 0) cross += series[i] * series[i - 1];
  }
  if (!(total > 0.0)) return 1.0;
  const double rho = std::min(std::abs(cross / total), kMostCorrelation);
  const double length = std::pow(2.0 * rho / (1.0 - rho * rho), 2.0 / 3.0) *
                        std::cbrt(static_cast<double>(series.size()));
  return std::max(1.0, length);
}

Result<Bootstrap> bootstrap(const LeastSquaresProblem& problem,
                            std::span<const BoundedParameter> parameters, std::span<const double> p,
                            const BootstrapSettings& settings) {
  const auto at = linearise(problem, p);
  if (!at) return tl::unexpected(at.error());
  const double freedom =
      std::max(1.0, static_cast<double>(at->residual.size()) - static_cast<double>(p.size()));
  const Source source = source_of(problem, at->residual, freedom, settings);
  std::vector<BoundedParameter> starts(parameters.begin(), parameters.end());
  for (std::size_t k = 0; k < p.size(); ++k) starts[k].start = p[k];
  Bootstrap result;
  if (settings.resampling == Resampling::block) result.block_length = source.block_length;
  std::vector<std::vector<double>> found;
  std::string reason;
  for (std::size_t r = 0; r < settings.replicates; ++r) {
    // The residual is prediction less measurement, so measured noise enters with a minus.
    const Shifted again(problem,
                        at->residual + drawn_noise(source, at->residual.size(), r, settings));
    auto fit = minimise(again, starts, settings.solver);
    if (fit && fit->termination != Termination::failed) {
      found.push_back(std::move(fit->p));
    } else {
      ++result.failed;
      if (!fit) reason = fit.error().message();
    }
  }
  if (found.size() < 2 || result.failed > found.size()) {
    return failure(ErrorCode::numerics,
                   fmt::format("{} of {} replicates of the bootstrap could not be fitted {}",
                               result.failed, settings.replicates, reason),
                   "ask for at least 2 replicates, or take the profile likelihood");
  }
  result.replicate.resize(static_cast<Eigen::Index>(found.size()),
                          static_cast<Eigen::Index>(p.size()));
  for (std::size_t r = 0; r < found.size(); ++r) {
    result.replicate.row(static_cast<Eigen::Index>(r)) =
        Eigen::Map<const Eigen::RowVectorXd>(found[r].data(), static_cast<Eigen::Index>(p.size()));
  }
  summarise(result, settings.level);
  return result;
}

}  // namespace flexspline::estimators
