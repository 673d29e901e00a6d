#include "ode_fit/shooting_problem.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "ode_fit/guess.hpp"

namespace flexspline::estimators {
namespace {

double residual_size(const OdeLayout& layout, const LaidOutExperiment& experiment) {
  double size = 0.0;
  for (std::size_t o = 0; o < experiment.outputs(); ++o) {
    for (std::size_t i = 0; i < layout.states(); ++i) {
      size = std::max(size, std::abs(experiment.slope(o, i)) * layout.state_scale[i]);
    }
  }
  return size > 0.0 ? size : 1.0;
}

std::string spelled(const std::vector<OdeParameter>& unknowns, std::span<const double> q) {
  std::string text;
  for (std::size_t k = 0; k < unknowns.size(); ++k)
    text += fmt::format("{}{} = {:.6g}", k > 0 ? ", " : "", unknowns[k].name, q[k]);
  return text;
}

}  // namespace

ShootingProblem::ShootingProblem(const OdeLayout& layout, double tolerance, int most_segments)
    : layout_(layout), tolerance_(tolerance) {
  for (const auto& experiment : layout.experiments) add_segments(experiment, most_segments);
}

void ShootingProblem::add_segments(const LaidOutExperiment& experiment, int most_segments) {
  const auto& times = experiment.source.times;
  const std::size_t at_start = experiment.measured_at_start() ? 1 : 0;
  const std::size_t steps = times.size() - at_start;
  const std::size_t wanted = static_cast<std::size_t>(std::max(1, most_segments));
  const std::size_t count = std::max<std::size_t>(1, std::min(wanted, steps));
  std::vector<Source> start = experiment.initial;
  double from = experiment.start_time();
  for (std::size_t s = 0; s < count; ++s) {
    const std::size_t first = s == 0 ? 0 : segments_.back().last;
    Segment segment{&experiment, first, at_start + steps * (s + 1) / count};
    if (s > 0 || at_start == 0) segment.times.push_back(from);
    for (std::size_t k = first; k < segment.last; ++k) segment.times.push_back(times[k]);
    segment.start = start;
    segment.size = residual_size(layout_, experiment);
    if (s + 1 < count) {
      segment.next = layout_.unknowns.size() + nodes_++ * layout_.states();
      segment.multiplier.assign(layout_.states(), 0.0);
      for (std::size_t i = 0; i < start.size(); ++i) start[i] = {segment.next + i, 0.0};
      from = segment.times.back();
    }
    segments_.push_back(std::move(segment));
  }
}

std::size_t ShootingProblem::residuals(std::size_t block) const {
  return segments_[block].data() + segments_[block].multiplier.size();
}

std::vector<BoundedParameter> ShootingProblem::bounded_parameters() const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  std::vector<BoundedParameter> result;
  for (const auto& u : layout_.unknowns) result.push_back({u.start, u.lower, u.upper, u.scale});
  for (const auto& segment : segments_) {
    if (segment.multiplier.empty()) continue;
    const double times[] = {segment.experiment->start_time(), segment.times.back()};
    const auto guess = guess_states(layout_, *segment.experiment, times, tolerance_);
    for (std::size_t i = 0; i < layout_.states(); ++i) {
      const double start = guess[layout_.states() + i];
      result.push_back({start, -kInfinity, kInfinity, layout_.state_scale[i]});
    }
  }
  return result;
}

Result<void> ShootingProblem::evaluate(std::size_t block, std::span<const double> q,
                                       std::span<double> residual,
                                       std::span<double> jacobian) const {
  const Segment& segment = segments_[block];
  auto shot = shoot(layout_, q, segment.start, segment.times, tolerance_, !jacobian.empty());
  if (!shot) {
    return tl::unexpected(in_context(
        std::move(shot).error(), fmt::format("experiment '{}' at {}", segment.experiment->source.id,
                                             spelled(layout_.unknowns, q))));
  }
  std::ranges::fill(jacobian, 0.0);
  fill_data(segment, *shot, residual, jacobian, q.size());
  const std::size_t data = segment.data();
  if (!segment.multiplier.empty()) {
    fill_jumps(segment, *shot, q, residual.subspan(data),
               jacobian.empty() ? jacobian : jacobian.subspan(data * q.size()));
  }
  return {};
}

void ShootingProblem::fill_data(const Segment& segment, const Shot& shot,
                                std::span<double> residual, std::span<double> jacobian,
                                std::size_t columns) const {
  const LaidOutExperiment& experiment = *segment.experiment;
  std::size_t row = 0;
  for (std::size_t k = segment.first; k < segment.last; ++k) {
    const std::size_t instant = k - segment.first + segment.lead();
    for (std::size_t o = 0; o < experiment.outputs(); ++o) {
      if (!experiment.counts(k, o)) continue;
      residual[row] = experiment.residual(k, o, shot.at(instant));
      for (std::size_t i = 0; !jacobian.empty() && i < layout_.states(); ++i) {
        const double slope = experiment.slope(o, i);
        for (std::size_t d = 0; slope != 0.0 && d < shot.unknown.size(); ++d) {
          jacobian[row * columns + shot.unknown[d]] += slope * shot.derivative(instant, i, d);
        }
      }
      ++row;
    }
  }
}

void ShootingProblem::fill_jumps(const Segment& segment, const Shot& shot,
                                 std::span<const double> q, std::span<double> residual,
                                 std::span<double> jacobian) const {
  const std::size_t end = segment.times.size() - 1;
  for (std::size_t i = 0; i < layout_.states(); ++i) {
    const double gain = weight_ * segment.size / layout_.state_scale[i];
    residual[i] = gain * (shot.at(end)[i] - q[segment.next + i]) + segment.multiplier[i];
    if (jacobian.empty()) continue;
    for (std::size_t d = 0; d < shot.unknown.size(); ++d) {
      jacobian[i * q.size() + shot.unknown[d]] += gain * shot.derivative(end, i, d);
    }
    jacobian[i * q.size() + segment.next + i] -= gain;
  }
}

void ShootingProblem::set_weight(double weight) {
  for (auto& segment : segments_) {
    for (double& multiplier : segment.multiplier) multiplier *= weight_ / weight;
  }
  weight_ = weight;
}

Result<std::vector<double>> ShootingProblem::values(const Segment& segment,
                                                    std::span<const double> q) const {
  const auto block = static_cast<std::size_t>(&segment - segments_.data());
  std::vector<double> residual(residuals(block));
  auto done = evaluate(block, q, residual, {});
  if (!done) return tl::unexpected(std::move(done).error());
  return residual;
}

Result<Jumps> ShootingProblem::update_multipliers(std::span<const double> q) {
  Jumps jumps;
  for (auto& segment : segments_) {
    const auto residual = values(segment, q);
    if (!residual) return tl::unexpected(residual.error());
    for (std::size_t i = 0; i < segment.multiplier.size(); ++i) {
      const double total = (*residual)[segment.data() + i];
      const double jump = total - segment.multiplier[i];
      jumps.largest = std::max(jumps.largest, std::abs(jump) / (weight_ * segment.size));
      jumps.worth += std::abs(jump * total);
      segment.multiplier[i] = total;
    }
  }
  return jumps;
}

}  // namespace flexspline::estimators
