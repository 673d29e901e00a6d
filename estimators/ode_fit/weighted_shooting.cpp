#include "ode_fit/weighted_shooting.hpp"

#include <algorithm>

namespace flexspline::estimators {
namespace {

// One column of a table under a filter.
void whiten_column(const WhiteningFilter& filter, const std::vector<std::size_t>& rows,
                   std::span<double> table, std::size_t column, std::size_t columns) {
  std::vector<double> series;
  for (const std::size_t row : rows) series.push_back(table[row * columns + column]);
  filter.whiten(series);
  for (std::size_t k = 0; k < rows.size(); ++k) table[rows[k] * columns + column] = series[k];
}

}  // namespace

OutputRows rows_of(const LaidOutExperiment& experiment, std::size_t output) {
  OutputRows result;
  std::size_t row = 0;
  for (std::size_t k = 0; k < experiment.source.times.size(); ++k) {
    for (std::size_t o = 0; o < experiment.outputs(); ++o) {
      if (!experiment.counts(k, o)) continue;
      if (o == output) {
        result.row.push_back(row);
        result.time.push_back(experiment.source.times[k]);
      }
      ++row;
    }
  }
  return result;
}

WeightedShooting::WeightedShooting(const OdeLayout& layout, const ShootingProblem& shots)
    : layout_(layout), shots_(shots) {
  for (std::size_t b = 0; b < shots.blocks(); ++b) {
    const bool joins = b > 0 && !shots.experiment(b).whitening.empty() &&
                       &shots.experiment(b) == &shots.experiment(b - 1);
    if (!joins) groups_.push_back({b, b, 0});
    groups_.back().last = b + 1;
    groups_.back().data += shots.data(b);
  }
}

std::size_t WeightedShooting::residuals(std::size_t block) const {
  std::size_t sum = 0;
  for (std::size_t b = groups_[block].first; b < groups_[block].last; ++b) {
    sum += shots_.residuals(b);
  }
  return sum;
}

// All measurements of the group first, then its jumps.
Result<void> WeightedShooting::evaluate(std::size_t block, std::span<const double> q,
                                        std::span<double> residual,
                                        std::span<double> jacobian) const {
  const Group& group = groups_[block];
  const std::size_t columns = q.size();
  std::size_t data = 0;
  std::size_t jump = group.data;
  for (std::size_t b = group.first; b < group.last; ++b) {
    std::vector<double> own(shots_.residuals(b));
    std::vector<double> slopes(jacobian.empty() ? 0 : own.size() * columns);
    auto done = shots_.evaluate(b, q, own, slopes);
    if (!done) return done;
    for (std::size_t r = 0; r < own.size(); ++r) {
      const std::size_t to = r < shots_.data(b) ? data++ : jump++;
      residual[to] = own[r];
      if (jacobian.empty()) continue;
      std::ranges::copy(std::span(slopes).subspan(r * columns, columns),
                        jacobian.subspan(to * columns, columns).begin());
    }
  }
  const auto measured = residual.first(group.data);
  const auto slopes = jacobian.empty() ? jacobian : jacobian.first(group.data * columns);
  whiten(shots_.experiment(group.first), measured, slopes, columns);
  apply_loss(measured, slopes, columns);
  return {};
}

void WeightedShooting::whiten(const LaidOutExperiment& experiment, std::span<double> residual,
                              std::span<double> jacobian, std::size_t columns) const {
  for (std::size_t o = 0; o < experiment.whitening.size(); ++o) {
    const auto rows = rows_of(experiment, o).row;
    whiten_column(experiment.whitening[o], rows, residual, 0, 1);
    for (std::size_t k = 0; !jacobian.empty() && k < columns; ++k) {
      whiten_column(experiment.whitening[o], rows, jacobian, k, columns);
    }
  }
}

void WeightedShooting::apply_loss(std::span<double> residual, std::span<double> jacobian,
                                  std::size_t columns) const {
  if (layout_.loss.squared()) return;
  for (std::size_t r = 0; r < residual.size(); ++r) {
    const auto changed = as_residual(layout_.loss, residual[r]);
    residual[r] = changed.residual;
    for (std::size_t k = 0; !jacobian.empty() && k < columns; ++k) {
      jacobian[r * columns + k] *= changed.slope;
    }
  }
}

Result<double> WeightedShooting::data_cost(std::span<const double> q) const {
  double sum = 0.0;
  for (std::size_t b = 0; b < groups_.size(); ++b) {
    std::vector<double> residual(residuals(b));
    auto done = evaluate(b, q, residual, {});
    if (!done) return tl::unexpected(std::move(done).error());
    for (std::size_t k = 0; k < groups_[b].data; ++k) sum += 0.5 * residual[k] * residual[k];
  }
  return sum;
}

}  // namespace flexspline::estimators
