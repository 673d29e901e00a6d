#include "given_model/given_residuals.hpp"

#include <algorithm>
#include <cmath>

#include "flexspline/core/drive_spec.hpp"
#include "flexspline/core/simulate.hpp"

namespace flexspline::estimators {
namespace {

constexpr double kRelativeStep = 1e-6;
constexpr double kLeastTorque = 0.1;  // that errors are relative to, of the root mean square

std::vector<std::size_t> rows_of(const TorsionRecord& record, std::size_t most) {
  const std::size_t stride = (record.time.size() + most - 1) / most;
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < record.time.size(); i += stride) {
    if (record.valid.empty() || record.valid[i]) rows.push_back(i);
  }
  return rows;
}

template <class T>
void thin(std::vector<T>& series, std::size_t stride) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < series.size(); i += stride) series[kept++] = series[i];
  series.resize(kept);
}

/// The reconstruction uses every sample, the simulation every stride-th.
void thin(GivenRecord& one, std::size_t most) {
  const std::size_t stride = (one.record.time.size() + most - 1) / most;
  if (stride < 2) return;
  for (auto* series : {&one.record.time, &one.record.motion, &one.record.effort, &one.motion.time,
                       &one.motion.position, &one.motion.velocity, &one.motion.acceleration}) {
    thin(*series, stride);
  }
  thin(one.record.valid, stride);
}

std::size_t valid_samples(const TorsionRecord& record) {
  if (record.valid.empty()) return record.time.size();
  return static_cast<std::size_t>(std::ranges::count(record.valid, true));
}

/// What an error in each row of a record is relative to, up to a factor common to all.
double size_of(const TorsionRecord& record, std::size_t row, ErrorWeight weight, double rms) {
  if (weight == ErrorWeight::even) return 1.0;
  return std::max(std::abs(record.effort[row]), kLeastTorque * rms);
}

/// The root of the samples that each residual stands for over its size, squares one in the mean.
void weigh(std::vector<GivenRecord>& records, const std::vector<std::size_t>& samples,
           ErrorWeight weight) {
  const double rms = rms_effort(records);
  double squares = 0.0;
  double rows = 0.0;
  for (std::size_t i = 0; i < records.size(); ++i) {
    GivenRecord& one = records[i];
    const double stands_for =
        static_cast<double>(samples[i]) / static_cast<double>(one.rows.size());
    for (std::size_t row : one.rows) {
      one.weight.push_back(std::sqrt(stands_for) / size_of(one.record, row, weight, rms));
      squares += one.weight.back() * one.weight.back();
    }
    rows += static_cast<double>(one.rows.size());
  }
  const double mean = std::sqrt(squares / rows);
  for (GivenRecord& one : records) {
    for (double& w : one.weight) w /= mean;
  }
}

double span_of(const GivenRecord& one) {
  const auto [low, high] = std::ranges::minmax(one.motion.position);
  return high - low;
}

/// A small motion may lie anywhere along the longest one, far from its own middle.
GivenParameter zero_of(const GivenRecord& one, double longest) {
  const auto [low, high] = std::ranges::minmax(one.motion.position);
  return {.name = "zero[" + one.record.id + "]",
          .unit = one.record.linear ? "m" : "rad",
          .start = 0.5 * (low + high),
          .lower = high - longest,
          .upper = low + longest};
}

}  // namespace

double rms_effort(const std::vector<GivenRecord>& records) {
  double sum = 0.0;
  double count = 0.0;
  for (const GivenRecord& one : records) {
    for (std::size_t i : one.rows) sum += one.record.effort[i] * one.record.effort[i];
    count += static_cast<double>(one.rows.size());
  }
  return std::sqrt(sum / std::max(1.0, count));
}

Result<std::vector<GivenRecord>> given_records(const std::vector<TorsionRecord>& records,
                                               std::size_t most_rows, std::size_t most_path,
                                               ErrorWeight weight) {
  std::vector<GivenRecord> list;
  std::vector<std::size_t> samples;
  for (const TorsionRecord& record : records) {
    auto smooth = reconstruct(record);
    if (!smooth) return tl::unexpected(in_context(smooth.error(), "recording " + record.id));
    GivenRecord one{record, std::move(smooth->motion), {}, {}};
    thin(one, most_path);
    one.rows = rows_of(one.record, most_rows);
    list.push_back(std::move(one));
    samples.push_back(valid_samples(record));
  }
  weigh(list, samples, weight);
  return list;
}

GivenResiduals::GivenResiduals(const ModelSpec& model, std::vector<GivenParameter> parameters,
                               const std::vector<GivenRecord>& records, bool each_zero)
    : model_(model), records_(records) {
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    values_.push_back(parameters[k].start);
    if (parameters[k].held) continue;
    free_.push_back(k);
    unknowns_.push_back(std::move(parameters[k]));
  }
  double longest = 0.0;
  for (const GivenRecord& one : records) longest = std::max(longest, span_of(one));
  for (std::size_t i = 0; each_zero && i < records.size(); ++i) {
    unknowns_.push_back(zero_of(records[i], longest));
  }
  for (const GivenParameter& one : unknowns_) sizes_.push_back(std::abs(one.start));
}

ModelSpec GivenResiduals::model_at(std::span<const double> q) const {
  std::vector<double> values = values_;
  for (std::size_t k = 0; k < free_.size(); ++k) values[free_[k]] = q[k];
  return with_parameters({.torsion = model_}, {}, values).torsion;
}

Result<std::vector<double>> GivenResiduals::predict(std::size_t block,
                                                    std::span<const double> q) const {
  const GivenRecord& one = records_[block];
  const bool shifted = unknowns_.size() > free_.size();
  Motion moved;
  if (shifted) {
    moved = one.motion;
    for (double& x : moved.position) x -= q[free_.size() + block];
  }
  const auto whole = simulate_torque(model_at(q), shifted ? moved : one.motion);
  if (!whole) return whole;
  std::vector<double> rows;
  rows.reserve(one.rows.size());
  for (std::size_t i : one.rows) rows.push_back((*whole)[i]);
  return rows;
}

std::vector<double> GivenResiduals::measured(std::size_t block) const {
  std::vector<double> rows;
  for (std::size_t i : records_[block].rows) rows.push_back(records_[block].record.effort[i]);
  return rows;
}

double GivenResiduals::step(std::size_t unknown, std::span<const double> q) const {
  const double size = std::max(std::abs(q[unknown]), sizes_[unknown]);
  return kRelativeStep * (size > 0.0 ? size : 1.0);
}

Result<void> GivenResiduals::evaluate(std::size_t block, std::span<const double> q,
                                      std::span<double> residual,
                                      std::span<double> jacobian) const {
  const auto at = predict(block, q);
  if (!at) return tl::unexpected(at.error());
  const std::vector<double> target = measured(block);
  const std::vector<double>& weight = records_[block].weight;
  for (std::size_t i = 0; i < target.size(); ++i) residual[i] = weight[i] * (target[i] - (*at)[i]);
  if (jacobian.empty()) return {};
  std::ranges::fill(jacobian, 0.0);
  const std::size_t n = unknowns_.size();
  std::vector<double> moved(q.begin(), q.end());
  for (std::size_t k = 0; k < n; ++k) {
    if (!acts(k, block)) continue;
    const double h = step(k, q);
    const double above = std::min(q[k] + h, unknowns_[k].upper);
    const double below = std::max(q[k] - h, unknowns_[k].lower);
    moved[k] = above;
    const auto up = predict(block, moved);
    moved[k] = below;
    const auto down = predict(block, moved);
    moved[k] = q[k];
    if (!up) return tl::unexpected(up.error());
    if (!down) return tl::unexpected(down.error());
    for (std::size_t i = 0; i < target.size(); ++i) {
      jacobian[i * n + k] = -weight[i] * ((*up)[i] - (*down)[i]) / (above - below);
    }
  }
  return {};
}

}  // namespace flexspline::estimators
