#include "diagnosis/noise.hpp"

#include <algorithm>
#include <cmath>

#include "diagnosis/middle.hpp"
#include "diagnosis/running_parabola.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

constexpr Index kHalfNarrow = 25;
constexpr Index kHalfWide = 80;
constexpr Index kLags = 40;
constexpr double kAlike = 0.5;       // autocorrelation
constexpr Index kFewestRows = 1000;  // of a recording

// Residual less running parabola, where the window fits; segment by segment.
std::vector<ArrayXd> fast_part(const Frame& frame, const ArrayXd& residual, Index half) {
  const ArrayXd weights = parabola_weights(half);
  std::vector<ArrayXd> parts;
  for (const Segment& s : frame.segments) {
    std::vector<double> part;
    for (Index r = s.first + half; r + half < s.first + s.count; ++r) {
      if (frame.usable.segment(r - half, 2 * half + 1).minCoeff() == 0.0) continue;
      part.push_back(residual[r] - (weights * residual.segment(r - half, 2 * half + 1)).sum());
    }
    parts.push_back(Eigen::Map<ArrayXd>(part.data(), static_cast<Index>(part.size())));
  }
  return parts;
}

// Of the fast part about a wide parabola, lags 1 to kLags; zero where nothing is left.
ArrayXd autocorrelation(const Frame& frame, const ArrayXd& residual) {
  double variance = 0.0;
  ArrayXd product = ArrayXd::Zero(kLags);
  for (const ArrayXd& part : fast_part(frame, residual, kHalfWide)) {
    if (part.size() <= kLags) continue;
    variance += part.square().sum();
    for (Index k = 1; k <= kLags; ++k) {
      const Index n = part.size() - k;
      product[k - 1] += (part.head(n) * part.tail(n)).sum();
    }
  }
  if (!(variance > 0.0)) return product;
  // The parabola itself takes its middle weight from every autocorrelation.
  return product / variance + parabola_weights(kHalfWide)[kHalfWide];
}

}  // namespace

std::vector<double> noise_levels(const Frame& frame, const ArrayXd& residual) {
  const double kept = 1.0 - parabola_weights(kHalfNarrow)[kHalfNarrow];
  std::vector<double> levels;
  std::vector<double> known;
  for (const ArrayXd& part : fast_part(frame, residual, kHalfNarrow)) {
    levels.push_back(part.size() > 8 ? std::sqrt(part.square().mean() / kept) : 0.0);
    if (levels.back() > 0.0) known.push_back(levels.back());
  }
  const double typical = middle(known);
  for (double& level : levels) level = std::max(level, 0.5 * typical);
  return levels;
}

double noise_colour(const Frame& frame, const ArrayXd& residual) {
  return std::max(1.0, 1.0 + 2.0 * autocorrelation(frame, residual).sum());
}

Index rows_alike(const Frame& frame, const ArrayXd& residual) {
  const ArrayXd correlation = autocorrelation(frame, residual);
  Index lag = 1;
  while (lag <= kLags && correlation[lag - 1] > kAlike) ++lag;
  return lag;
}

ArrayXd weights_of_fit(const Frame& frame, const ArrayXd& weight, Index alike) {
  ArrayXd few = ArrayXd::Zero(weight.size());
  for (const Segment& s : frame.segments) {
    const Index rows = (weight.segment(s.first, s.count) > 0.0).count();
    const Index stride = std::max<Index>(1, std::min(alike, rows / kFewestRows));
    const double each = std::sqrt(static_cast<double>(stride));
    for (Index r = s.first + stride / 2; r < s.first + s.count; r += stride) {
      few[r] = each * weight[r];
    }
  }
  return few;
}

ArrayXd weights_of(const Frame& frame, const std::vector<double>& level) {
  ArrayXd weight = frame.usable;
  for (std::size_t i = 0; i < frame.segments.size(); ++i) {
    const Segment& s = frame.segments[i];
    weight.segment(s.first, s.count) *= level[i] > 0.0 ? 1.0 / level[i] : 0.0;
  }
  return weight;
}

}  // namespace flexspline::studies
