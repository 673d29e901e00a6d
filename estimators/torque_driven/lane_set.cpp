#include "torque_driven/lane_set.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <new>
#include <numeric>

#include "flexspline/core/in_parallel.hpp"

namespace flexspline::estimators {
namespace {

constexpr std::align_val_t kLine{64};
// Layers of a stiff system at rest die out within the first sample; the formula's error with them.
constexpr int kFirstParts = 8;
constexpr std::size_t kStretchSteps = 128;

std::size_t nodes(LaneFormula formula) { return formula == LaneFormula::radau ? 3 : 2; }

std::size_t steps(const LaneBlock& block) {
  return static_cast<std::size_t>(block.first_parts + (block.intervals - 1) * block.parts);
}

std::size_t torque_rows(LaneFormula formula, const LaneBlock& block) {
  return nodes(formula) * steps(block) + (formula == LaneFormula::runge_kutta ? 1 : 0);
}

}  // namespace

void LaneSet::Alignment::operator()(double* memory) const { ::operator delete[](memory, kLine); }

LaneSet::LaneSet(const DrivenProblem& problem, const std::vector<LanePlan>& plans,
                 InstructionSet set, std::size_t threads)
    : problem_(problem), threads_(threads) {
  expects(problem.size() <= kMostLaneDirections, "a kernel has 40 directions at most");
  const std::size_t columns = problem.size() + 1;
  sums_.normal.resize(columns * (columns + 1) / 2);
  sums_.squares.resize(problem.series.size());
  sums_.stiffness.resize(problem.series.size());
  arrange(plans, set);
  in_parallel(blocks_.size(), threads_, [this](std::size_t b) { pack(blocks_[b]); });
}

// Side by side lies what is integrated alike; the dearest blocks come first.
void LaneSet::arrange(const std::vector<LanePlan>& plans, InstructionSet set) {
  std::vector<std::size_t> order(plans.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto cost = [&](std::size_t s) {
    const auto work = static_cast<std::size_t>(plans[s].parts) * problem_.series[s].intervals();
    return std::pair(plans[s].formula == LaneFormula::radau, work);
  };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return cost(a) > cost(b); });
  const auto most = static_cast<std::size_t>(most_lanes(set));
  for (std::size_t at = 0; at < order.size();) {
    Packed packed;
    packed.plan = plans[order[at]];
    while (at < order.size() && packed.series.size() < most &&
           plans[order[at]].formula == packed.plan.formula) {
      packed.series.push_back(order[at++]);
    }
    const std::size_t lanes = std::max<std::size_t>(2, std::bit_ceil(packed.series.size()));
    packed.block.lanes = static_cast<int>(lanes);
    packed.kernel = lane_kernel(set, packed.plan.formula, packed.block.lanes);
    blocks_.push_back(std::move(packed));
  }
}

// How long a block is, and whether widths and weights are the same at every sample.
void LaneSet::measure(Packed& packed) const {
  LaneBlock& block = packed.block;
  bool even = true;
  bool alike = true;
  for (const std::size_t s : packed.series) {
    const DrivenSeries& one = problem_.series[s];
    const auto intervals = static_cast<long>(one.intervals());
    even = even && one.step > 0.0;
    alike = alike && one.all_valid && (block.intervals == 0 || block.intervals == intervals);
    block.intervals = std::max(block.intervals, intervals);
  }
  block.parts = packed.plan.parts;
  block.first_parts =
      packed.plan.formula == LaneFormula::radau ? kFirstParts * block.parts : block.parts;
  block.width_stride = even ? 0 : block.lanes;
  block.weight_stride = alike ? 0 : block.lanes;
}

void LaneSet::pack(Packed& packed) const {
  measure(packed);
  LaneBlock& block = packed.block;
  const auto lanes = static_cast<std::size_t>(block.lanes);
  const auto rows = static_cast<std::size_t>(block.intervals);
  const std::size_t torque = torque_rows(packed.plan.formula, block);
  const std::size_t width = block.width_stride == 0 ? 1 : rows;
  const std::size_t weight = block.weight_stride == 0 ? 1 : rows;
  const std::size_t total = torque + width + 2 * rows + weight + 2 + sums_.normal.size();
  packed.memory.reset(new (kLine) double[total * lanes]);
  double* at = packed.memory.get();
  const auto next = [&](std::size_t count) { return std::exchange(at, at + count * lanes); };
  double* const torque_at = next(torque);
  double* const width_at = next(width);
  double* const measured_at = next(rows);
  double* const weight_at = next(weight);
  double* const initial_at = next(1);
  packed.stiffness = next(1);
  packed.normal = next(sums_.normal.size());
  packed.state = next(rows);
  fill_torque(packed, block, 0, torque_at);
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    fill_lane(packed, lane, width_at, measured_at, weight_at);
    initial_at[lane] = series_in(packed, lane).initial;
  }
  block.torque = torque_at;
  block.width = width_at;
  block.measured = measured_at;
  block.weight = weight_at;
  block.initial = initial_at;
}

// A lane without a recording repeats the last one with weight 0.
const DrivenSeries& LaneSet::series_in(const Packed& packed, std::size_t lane) const {
  return problem_.series[packed.series[std::min(lane, packed.series.size() - 1)]];
}

// At the nodes of a block of steps that begins at an interval.
void LaneSet::fill_torque(const Packed& packed, const LaneBlock& block, std::size_t from,
                          double* torque) const {
  const auto lanes = static_cast<std::size_t>(block.lanes);
  const bool radau = packed.plan.formula == LaneFormula::radau;
  const double* const shares = radau ? kRadauNodes : kRungeKuttaNodes;
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const DrivenSeries& one = series_in(packed, lane);
    double* t = torque + lane;
    if (!radau) {
      *t = one.torque[std::min(from, one.intervals())];
      t += lanes;
    }
    for (std::size_t row = 0; row < static_cast<std::size_t>(block.intervals); ++row) {
      const bool inside = from + row < one.intervals();
      const int parts = row == 0 ? block.first_parts : block.parts;
      for (int part = 0; part < parts; ++part) {
        for (std::size_t k = 0; k < nodes(packed.plan.formula); ++k, t += lanes) {
          *t = inside ? one.torque_at(from + row, (part + shares[k]) / parts) : one.torque.back();
        }
      }
    }
  }
}

void LaneSet::fill_lane(const Packed& packed, std::size_t lane, double* width, double* measured,
                        double* weight) const {
  const LaneBlock& block = packed.block;
  const auto lanes = static_cast<std::size_t>(block.lanes);
  const bool used = lane < packed.series.size();
  const DrivenSeries& one = series_in(packed, lane);
  for (std::size_t n = 0; n < static_cast<std::size_t>(block.intervals); ++n) {
    const bool inside = n < one.intervals();
    const std::size_t last = inside ? n : one.intervals() - 1;
    measured[n * lanes + lane] = one.motion[last + 1];
    if (block.width_stride > 0 || n == 0) width[n * lanes + lane] = one.width(last);
    if (block.weight_stride > 0 || n == 0) {
      weight[n * lanes + lane] = used && inside ? one.weight[n + 1] : 0.0;
    }
  }
}

LaneLaws LaneSet::laws(std::span<const double> p) const {
  return {.f = problem_.f, .g = problem_.g, .h = problem_.h, .coefficient = p.data()};
}

const LaneSums& LaneSet::sums(std::span<const double> p) {
  in_parallel(blocks_.size(), threads_, [&](std::size_t b) {
    Packed& packed = blocks_[b];
    packed.kernel(laws(p), packed.block, {packed.normal, packed.stiffness, packed.state});
  });
  states_at_.assign(p.begin(), p.end());
  std::ranges::fill(sums_.normal, 0.0);
  for (const Packed& packed : blocks_) {
    const auto lanes = static_cast<std::size_t>(packed.block.lanes);
    for (std::size_t k = 0; k < sums_.normal.size(); ++k) {
      for (std::size_t lane = 0; lane < packed.series.size(); ++lane) {
        sums_.normal[k] += packed.normal[k * lanes + lane];
      }
    }
    for (std::size_t lane = 0; lane < packed.series.size(); ++lane) {
      sums_.squares[packed.series[lane]] = packed.normal[(sums_.normal.size() - 1) * lanes + lane];
      sums_.stiffness[packed.series[lane]] = packed.stiffness[lane];
    }
  }
  return sums_;
}

void LaneSet::integrate(const Packed& packed, std::span<const double> p) const {
  packed.kernel(laws(p), packed.block, {nullptr, packed.stiffness, packed.state});
}

std::vector<std::vector<double>> LaneSet::states(std::span<const double> p) {
  const bool known = std::ranges::equal(p, states_at_);
  std::vector<std::vector<double>> result(problem_.series.size());
  for (std::size_t s = 0; s < result.size(); ++s) result[s].resize(problem_.series[s].intervals());
  in_parallel(blocks_.size(), threads_, [&](std::size_t b) {
    Packed& packed = blocks_[b];
    const auto lanes = static_cast<std::size_t>(packed.block.lanes);
    if (!known) integrate(packed, p);
    for (std::size_t lane = 0; lane < packed.series.size(); ++lane) {
      auto& out = result[packed.series[lane]];
      for (std::size_t n = 0; n < out.size(); ++n) out[n] = packed.state[n * lanes + lane];
    }
  });
  states_at_.assign(p.begin(), p.end());
  return result;
}

// Stretch by stretch, each so short that it stays in the cache.
void LaneSet::compare_by_half_steps(const Packed& packed, std::span<const double> p,
                                    std::vector<double>& change) const {
  const auto lanes = static_cast<std::size_t>(packed.block.lanes);
  const auto intervals = static_cast<std::size_t>(packed.block.intervals);
  const auto parts = static_cast<std::size_t>(packed.block.parts);
  const std::size_t stretch = std::max<std::size_t>(1, kStretchSteps / parts);
  std::vector<double> torque;
  std::vector<double> state;
  std::vector<double> initial(packed.block.initial, packed.block.initial + lanes);
  LaneBlock half = packed.block;
  half.parts = 2 * packed.block.parts;
  for (std::size_t from = 0; from < intervals; from += stretch) {
    const std::size_t rows = std::min(stretch, intervals - from);
    state.resize(rows * lanes);
    half.intervals = static_cast<long>(rows);
    half.first_parts = from == 0 ? 2 * packed.block.first_parts : half.parts;
    torque.resize(torque_rows(packed.plan.formula, half) * lanes);
    fill_torque(packed, half, from, torque.data());
    half.torque = torque.data();
    half.width = packed.block.width + from * static_cast<std::size_t>(half.width_stride);
    half.initial = initial.data();
    packed.kernel(laws(p), half, {nullptr, packed.stiffness, state.data()});
    for (std::size_t lane = 0; lane < packed.series.size(); ++lane) {
      double& most = change[packed.series[lane]];
      most = std::max(most, largest_difference(packed, lane, from, state));
    }
    std::copy_n(state.end() - static_cast<long>(lanes), lanes, initial.begin());
  }
}

// Of a lane's states from ones that begin at an interval, weighted.
double LaneSet::largest_difference(const Packed& packed, std::size_t lane, std::size_t from,
                                   std::span<const double> others) const {
  const DrivenSeries& one = problem_.series[packed.series[lane]];
  const auto lanes = static_cast<std::size_t>(packed.block.lanes);
  const std::size_t end = std::min(from + others.size() / lanes, one.intervals());
  double largest = 0.0;
  for (std::size_t n = from; n < end; ++n) {
    const double difference = packed.state[n * lanes + lane] - others[(n - from) * lanes + lane];
    largest = std::max(largest, one.weight[n + 1] * std::abs(difference));
  }
  return largest;
}

std::vector<double> LaneSet::change_by_half_steps(std::span<const double> p) {
  const bool known = std::ranges::equal(p, states_at_);
  std::vector<double> change(problem_.series.size());
  in_parallel(blocks_.size(), threads_, [&](std::size_t b) {
    if (!known) integrate(blocks_[b], p);
    compare_by_half_steps(blocks_[b], p, change);
  });
  states_at_.assign(p.begin(), p.end());
  return change;
}

}  // namespace flexspline::estimators
