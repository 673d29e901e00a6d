#include "diagnosis/model/noise.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "diagnosis/frame/middle.hpp"
#include "diagnosis/frame/repeats.hpp"
#include "diagnosis/frame/running.hpp"
#include "flexspline/core/estimate.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

constexpr Index kHalfNarrow = 25;
constexpr Index kHalfWide = 80;
constexpr Index kFewestFast = 9;  // rows that tell a level to a quarter of itself
constexpr Index kLags = 40;
constexpr double kAlike = 0.5;       // autocorrelation
constexpr Index kFewestRows = 1000;  // of a recording
constexpr Index kMostLags = 400;
constexpr double kSettled = 0.02;  // change of a level, of itself
constexpr int kMostPasses = 10;    // by which a level has settled

// A line across rows that do not count, level at the ends.
ArrayXd bridged(ArrayXd x) {
  Index known = -1;
  for (Index r = 0; r < x.size(); ++r) {
    if (std::isnan(x[r])) continue;
    const double from = known < 0 ? x[r] : x[known];
    for (Index k = known + 1; k < r; ++k) {
      x[k] = from + (x[r] - from) * static_cast<double>(k - known) / static_cast<double>(r - known);
    }
    known = r;
  }
  for (Index k = known + 1; k < x.size(); ++k) x[k] = known < 0 ? 0.0 : x[known];
  return x;
}

// Residual less running parabola, segment by segment; NaN where the window does not fit or the row
// does not count.
std::vector<ArrayXd> fast_part(const Frame& frame, const ArrayXd& residual, Index half) {
  const ArrayXd weights = parabola_weights(half);
  std::vector<ArrayXd> parts;
  for (const Segment& s : frame.segments) {
    const ArrayXd whole = bridged(residual.segment(s.first, s.count));
    ArrayXd part = ArrayXd::Constant(s.count, kNotComputed);
    for (Index r = half; r + half < s.count; ++r) {
      const bool there = frame.usable.segment(s.first + r - half, 2 * half + 1).minCoeff() > 0.0;
      if (!there || std::isnan(residual[s.first + r])) continue;
      part[r] = whole[r] - (weights * whole.segment(r - half, 2 * half + 1)).sum();
    }
    parts.push_back(std::move(part));
  }
  return parts;
}

/// Autocorrelation of noise, all recordings together; NaN rows are not there.
class Autocorrelation {
 public:
  explicit Autocorrelation(const std::vector<ArrayXd>& parts) {
    for (const ArrayXd& part : parts) {
      const ArrayXd there = part.isNaN().select(ArrayXd::Zero(part.size()), 1.0);
      if (there.sum() < static_cast<double>(kFewestCompared)) continue;
      parts_.push_back({part.isNaN().select(0.0, part), there});
    }
  }

  /// False where nothing is there, or no noise.
  bool is_known() const { return product(0) > 0.0; }
  double at(Index lag) const { return product(lag) / product(0); }

 private:
  struct Part {
    ArrayXd value;  // 0 where it is not there
    ArrayXd there;
  };

  double product(Index lag) const {
    double sum = 0.0, count = 0.0;
    for (const Part& part : parts_) {
      const Index n = part.value.size() - lag;
      if (n < 1) continue;
      sum += (part.value.head(n) * part.value.tail(n)).sum();
      count += (part.there.head(n) * part.there.tail(n)).sum();
    }
    return count > 0.0 ? sum / count : 0.0;
  }

  std::vector<Part> parts_;
};

// Of the fast part about a wide parabola, lags 1 to kLags; zero where nothing is left.
ArrayXd fast_autocorrelation(const Frame& frame, const ArrayXd& residual) {
  const Autocorrelation fast(fast_part(frame, residual, kHalfWide));
  if (!fast.is_known()) return ArrayXd::Zero(kLags);
  // The parabola itself takes its middle weight from every autocorrelation.
  const double taken = parabola_weights(kHalfWide)[kHalfWide];
  return ArrayXd::NullaryExpr(kLags, [&](Index k) { return fast.at(k + 1) + taken; });
}

// Sum of autocorrelations, by pairs while these are positive (Geyer 1992, initial positive
// sequence): as many lags as the noise is long.
double long_run(const Autocorrelation& noise) {
  double sum = -1.0;
  for (Index lag = 0; lag < kMostLags; lag += 2) {
    const double pair = noise.at(lag) + noise.at(lag + 1);
    if (!(pair > 0.0)) break;
    sum += 2.0 * pair;
  }
  return std::max(1.0, sum);
}

double rms_of(const ArrayXd& part, Index fewest) {
  double sum = 0.0, count = 0.0;
  for (const double value : part) {
    if (!std::isnan(value)) sum += value * value, count += 1.0;
  }
  return count < static_cast<double>(fewest) ? 0.0 : std::sqrt(sum / count);
}

/// Of the recordings that repeat: the noise, and by how much it is larger than its fast part.
struct Usual {
  double level = 0.0;
  double over_fast = 1.0;
};

Usual usual_of(const std::vector<double>& fast, const std::vector<double>& whole) {
  std::vector<double> levels, ratios;
  for (std::size_t i = 0; i < fast.size(); ++i) {
    if (!(fast[i] > 0.0 && whole[i] > 0.0)) continue;
    levels.push_back(whole[i]);
    ratios.push_back(std::max(1.0, whole[i] / fast[i]));
  }
  if (levels.empty()) return {};
  return {middle(std::move(levels)), middle(std::move(ratios))};
}

std::vector<double> fast_levels(const Frame& frame, const ArrayXd& residual) {
  const double kept = 1.0 - parabola_weights(kHalfNarrow)[kHalfNarrow];
  std::vector<double> levels;
  for (const ArrayXd& part : fast_part(frame, residual, kHalfNarrow)) {
    levels.push_back(rms_of(part, kFewestFast) / std::sqrt(kept));
  }
  return levels;
}

// What a torque that is told by an acceleration is known to; 0 of those that a sensor measures.
std::vector<double> known_levels(const Frame& frame, Equation equation) {
  std::vector<double> levels(frame.segments.size(), 0.0);
  if (equation != Equation::torsion || !frame.torque_by_inertia) return levels;
  const ArrayXd rows = frame.rows_of(equation);
  const ArrayXd error = frame.load_inertia * frame.load_acceleration_error;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const Segment& s = frame.segments[i];
    const ArrayXd there = rows.segment(s.first, s.count);
    if (there.sum() == 0.0) continue;
    levels[i] = std::sqrt((error.segment(s.first, s.count).square() * there).sum() / there.sum());
  }
  return levels;
}

}  // namespace

bool is_settled(double level, double before) {
  return std::abs(level - before) <= kSettled * before;
}

std::vector<double> noise_levels(const Frame& frame, const ArrayXd& residual) {
  std::vector<double> levels = fast_levels(frame, residual);
  std::vector<double> whole;
  for (const ArrayXd& part : unrepeated(frame, residual)) {
    whole.push_back(rms_of(part, kFewestCompared));
  }
  const Usual usual = usual_of(levels, whole);
  std::vector<double> known;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    // Where nothing repeats, the noise of the others or its slow part beside this fast one.
    const double slow =
        whole[i] > 0.0 ? whole[i] : std::min(usual.level, usual.over_fast * levels[i]);
    levels[i] = std::max(levels[i], slow);
    if (levels[i] > 0.0) known.push_back(levels[i]);
  }
  const double typical = middle(known);
  for (double& level : levels) level = std::max(level, 0.5 * typical);
  return levels;
}

double noise_colour(const Frame& frame, const ArrayXd& residual) {
  const Autocorrelation noise(unrepeated(frame, residual));
  if (noise.is_known()) return long_run(noise);
  return kUnseenColour * std::max(1.0, 1.0 + 2.0 * fast_autocorrelation(frame, residual).sum());
}

Index rows_alike(const Frame& frame, const ArrayXd& residual) {
  const Autocorrelation noise(unrepeated(frame, residual));
  const bool known = noise.is_known();
  const ArrayXd otherwise = known ? ArrayXd() : fast_autocorrelation(frame, residual);
  Index lag = 1;
  while (lag <= kLags && (known ? noise.at(lag) : otherwise[lag - 1]) > kAlike) ++lag;
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

ArrayXd deviation_of(const Frame& frame, const EquationNoise& noise) {
  ArrayXd deviation = ArrayXd::Zero(frame.rows());
  for (std::size_t i = 0; i < frame.segments.size(); ++i) {
    const Segment& s = frame.segments[i];
    deviation.segment(s.first, s.count).setConstant(noise.level[i]);
  }
  if (noise.of_motion.size() == 0) return deviation;
  return (deviation.square() + noise.of_motion.square()).sqrt();
}

ArrayXd motion_is_known(const Frame& frame, const EquationNoise& noise) {
  if (noise.of_motion.size() == 0) return ArrayXd::Ones(frame.rows());
  return (noise.of_motion <= deviation_of(frame, {.level = noise.level})).cast<double>();
}

ArrayXd as_noise_alone(const Frame& frame, const EquationNoise& noise, const ArrayXd& residual) {
  if (noise.of_motion.size() == 0) return residual;
  const ArrayXd alone = deviation_of(frame, {.level = noise.level});
  return (noise.of_motion > 0.0).select(residual * alone / deviation_of(frame, noise), residual);
}

ArrayXd weights_of(const Frame& frame, Equation equation, const EquationNoise& noise) {
  const ArrayXd deviation = deviation_of(frame, noise);
  return (deviation > 0.0).select(frame.rows_of(equation) / deviation, 0.0);
}

EquationNoise noise_without(const Frame& frame, Equation equation, const ArrayXd& residual,
                            ArrayXd of_motion, std::vector<double> level) {
  const int passes = level.empty() ? kMostPasses : 1;
  const std::vector<double> known = known_levels(frame, equation);
  const auto levels_of = [&](const ArrayXd& signal) {
    std::vector<double> levels = noise_levels(frame, signal);
    std::ranges::transform(levels, known, levels.begin(),
                           [](double measured, double least) { return std::max(measured, least); });
    return levels;
  };
  if (level.empty()) level = levels_of(residual);
  EquationNoise noise{.level = std::move(level), .of_motion = std::move(of_motion)};
  ArrayXd alone;
  for (int pass = 0; pass < passes; ++pass) {
    alone = (motion_is_known(frame, noise) > 0.0)
                .select(as_noise_alone(frame, noise, residual), kNotComputed);
    const auto before = std::exchange(noise.level, levels_of(alone));
    if (std::ranges::equal(noise.level, before, is_settled)) break;
  }
  noise.colour = noise_colour(frame, alone);
  noise.alike = rows_alike(frame, alone);
  return noise;
}

}  // namespace flexspline::studies
