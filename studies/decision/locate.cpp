#include <algorithm>
#include <cmath>

#include "decision/decide.hpp"
#include "diagnosis/middle.hpp"

namespace flexspline::studies::decision {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr Index kWindows = 20;            // of a recording, each half over the next
constexpr double kMedianSquare = 0.4549;  // of a standard normal
constexpr double kOneRecording = 0.7;     // of the excess power: one recording's own
constexpr double kMostOfIt = 0.5;         // of a recording: more is no burst
constexpr Index kFewest = 12;             // rows of a window

double high(const VectorXd& x) {
  std::vector<double> sizes(x.data(), x.data() + x.size());
  for (double& v : sizes) v = std::abs(v);
  return percentile(std::move(sizes), 0.99);
}

/// Rows [first, last) of the equation that are of one recording.
std::vector<std::pair<Index, Index>> recordings(const EquationRows& one, std::size_t count) {
  std::vector<std::pair<Index, Index>> list(count, {0, 0});
  for (Index i = 0; i < one.rows.size(); ++i) {
    auto& span = list[one.rows.segment[static_cast<std::size_t>(i)]];
    if (span.second == 0) span.first = i;
    span.second = i + 1;
  }
  return list;
}

double middle_square(const VectorXd& x) {
  std::vector<double> squares;
  for (const double v : x) squares.push_back(v * v);
  return middle(std::move(squares)) / kMedianSquare;
}

// The window in which a signal is largest.
void place(const Bench& bench, const EquationRows& one, const VectorXd& signal, Located& at) {
  double largest = 0.0;
  for (const auto& [first, last] : recordings(one, bench.frame->segments.size())) {
    const Index width = std::max<Index>(1, (last - first) / kWindows);
    for (Index i = first; i + width <= last; i += std::max<Index>(1, width / 2)) {
      const double power = signal.segment(i, width).squaredNorm();
      if (!(power > largest)) continue;
      largest = power;
      const auto row = [&](Index k) { return one.rows.row[static_cast<std::size_t>(k)]; };
      at.segment = one.rows.segment[static_cast<std::size_t>(i)];
      at.from_s = bench.frame->time[row(i)];
      at.to_s = bench.frame->time[row(i + width - 1)];
    }
  }
}

}  // namespace

std::vector<Located> locate(const Bench& bench, const Fit& fit) {
  std::vector<Located> list;
  for (std::size_t e = 0; e < bench.equations.size(); ++e) {
    const EquationRows& one = bench.equations[e];
    double whole = 0.0;
    std::vector<Located> own;
    for (std::size_t k = 0; k < fit.system.components[e].size(); ++k) {
      const Component& c = fit.system.components[e][k];
      if (c.nuisance) continue;
      const VectorXd part = part_of(bench, fit, e, k);
      const double square = part.squaredNorm();
      if (!(square > 0.0)) continue;
      whole += square;
      Located at{one.equation, c.coordinate, c.says, square, high(part) / (100.0 * one.unit)};
      place(bench, one, part, at);
      own.push_back(std::move(at));
    }
    for (Located& at : own) at.share /= whole;
    list.insert(list.end(), own.begin(), own.end());
  }
  std::ranges::stable_sort(list, std::ranges::greater{}, &Located::size);
  return list;
}

std::optional<Burst> find_burst(const Bench& bench, const Fit& fit,
                                const Calibration& calibration) {
  std::optional<Burst> best;
  for (std::size_t e = 0; e < bench.equations.size(); ++e) {
    const EquationRows& one = bench.equations[e];
    const VectorXd raw = unexplained(bench, fit, e) - remainder(bench, fit, e);
    NoiseModel plain = one.noise;
    plain.weight.setOnes();
    const VectorXd white = whitened(plain, one.rows, raw).col(0);
    const auto spans = recordings(one, bench.frame->segments.size());
    std::vector<Burst> found(spans.size());
    std::vector<double> power(spans.size(), 0.0);
    for (std::size_t s = 0; s < spans.size(); ++s) {
      const auto [first, last] = spans[s];
      const Index width = (last - first) / kWindows;
      if (width < kFewest) continue;
      const double usual = middle_square(white.segment(first, last - first));
      const double noise = middle_square(raw.segment(first, last - first));
      // Not at its ends, where a smoothing spline's derivatives are loose.
      for (Index i = first + width; i + 2 * width <= last; i += width / 2) {
        const double ratio =
            white.segment(i, width).squaredNorm() / static_cast<double>(width) / usual;
        const double mean = raw.segment(i, width).squaredNorm() / static_cast<double>(width);
        const double size = std::sqrt(std::max(mean - noise, 0.0)) / (100.0 * one.unit);
        if (ratio < calibration.burst_ratio || size < calibration.interest) continue;
        Burst& b = found[s];
        const Index from = one.rows.row[static_cast<std::size_t>(i)];
        const Index to = one.rows.row[static_cast<std::size_t>(i + width - 1)];
        if (b.count == 0) b = {one.equation, s, from, 0, 0.0, 0.0};
        b.count = to - b.first + 1;
        b.ratio = std::max(b.ratio, ratio);
        b.size = std::max(b.size, size);
        power[s] += (ratio - 1.0) * static_cast<double>(width);
      }
    }
    double whole = 0.0;
    for (const double p : power) whole += p;
    for (std::size_t s = 0; s < spans.size(); ++s) {
      const auto rows = static_cast<double>(bench.frame->segments[s].count);
      const bool alone = power[s] > kOneRecording * whole && power[s] > 0.0;
      if (!alone || static_cast<double>(found[s].count) > kMostOfIt * rows) continue;
      if (!best || found[s].ratio > best->ratio) best = found[s];
    }
  }
  return best;
}

}  // namespace flexspline::studies::decision
