#include "torque_driven/lane_set.hpp"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <new>
#include <numeric>

namespace flexspline::estimators {
namespace {

constexpr std::align_val_t kLine{64};
// Layers of a stiff system at rest die out within the first sample; the formula's error with them.
constexpr int kFirstParts = 8;

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
                 InstructionSet set, Crew& crew)
    : problem_(problem), crew_(crew) {
  expects(problem.size() <= kMostLaneDirections, "a kernel has 40 directions at most");
  const std::size_t columns = problem.size() + 1;
  sums_.normal.resize(columns * (columns + 1) / 2);
  sums_.squares.resize(problem.series.size());
  sums_.stiffness.resize(problem.series.size());
  arrange(plans, set);
  crew_.run(blocks_.size(), [this](std::size_t b) { pack(blocks_[b]); });
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
  if (packed.room < total * lanes) {
    packed.memory.reset(new (kLine) double[total * lanes]);
    packed.room = total * lanes;
  }
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
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    fill_lane(packed, lane, torque_at, width_at, measured_at, weight_at);
    const std::size_t s = packed.series[std::min(lane, packed.series.size() - 1)];
    initial_at[lane] = problem_.series[s].initial;
  }
  block.torque = torque_at;
  block.width = width_at;
  block.measured = measured_at;
  block.weight = weight_at;
  block.initial = initial_at;
}

// A lane without a recording repeats the last one with weight 0.
void LaneSet::fill_lane(const Packed& packed, std::size_t lane, double* torque, double* width,
                        double* measured, double* weight) const {
  const LaneBlock& block = packed.block;
  const auto lanes = static_cast<std::size_t>(block.lanes);
  const bool used = lane < packed.series.size();
  const DrivenSeries& one = problem_.series[packed.series[used ? lane : packed.series.size() - 1]];
  const bool radau = packed.plan.formula == LaneFormula::radau;
  const double* const shares = radau ? kRadauNodes : kRungeKuttaNodes;
  double* t = torque + lane;
  if (!radau) {
    *t = one.torque.front();
    t += lanes;
  }
  for (std::size_t n = 0; n < static_cast<std::size_t>(block.intervals); ++n) {
    const bool inside = n < one.intervals();
    const std::size_t last = inside ? n : one.intervals() - 1;
    const int parts = n == 0 ? block.first_parts : block.parts;
    for (int part = 0; part < parts; ++part) {
      for (std::size_t k = 0; k < nodes(packed.plan.formula); ++k, t += lanes) {
        *t = inside ? one.torque_at(n, (part + shares[k]) / parts) : one.torque.back();
      }
    }
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
  crew_.run(blocks_.size(), [&](std::size_t b) {
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
  crew_.run(blocks_.size(), [&](std::size_t b) {
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

double LaneSet::largest_difference(const Packed& a, const Packed& b, std::size_t lane) const {
  const DrivenSeries& one = problem_.series[a.series[lane]];
  const auto lanes = static_cast<std::size_t>(a.block.lanes);
  double largest = 0.0;
  for (std::size_t n = 0; n < one.intervals(); ++n) {
    const std::size_t at = n * lanes + lane;
    largest = std::max(largest, one.weight[n + 1] * std::abs(a.state[at] - b.state[at]));
  }
  return largest;
}

// Block by block, in one memory a thread: packed anew, integrated and compared in the cache.
std::vector<double> LaneSet::change_by_half_steps(std::span<const double> p) {
  const bool known = std::ranges::equal(p, states_at_);
  std::vector<double> change(problem_.series.size());
  std::atomic<std::size_t> next = 0;
  crew_.run(crew_.size(), [&](std::size_t) {
    Packed finer;
    for (std::size_t b = next++; b < blocks_.size(); b = next++) {
      const Packed& packed = blocks_[b];
      if (!known) integrate(packed, p);
      finer.series = packed.series;
      finer.plan = {packed.plan.formula, 2 * packed.plan.parts};
      finer.kernel = packed.kernel;
      finer.block = {.lanes = packed.block.lanes};
      pack(finer);
      integrate(finer, p);
      for (std::size_t lane = 0; lane < packed.series.size(); ++lane) {
        change[packed.series[lane]] = largest_difference(packed, finer, lane);
      }
    }
  });
  states_at_.assign(p.begin(), p.end());
  return change;
}

}  // namespace flexspline::estimators
