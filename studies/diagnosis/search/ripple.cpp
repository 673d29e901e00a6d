#include "diagnosis/search/ripple.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <tuple>
#include <utility>
#include <vector>

#include "diagnosis/frame/middle.hpp"
#include "diagnosis/frame/running.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXcd;
using Eigen::ArrayXd;
using Eigen::Index;

constexpr Index kHalfWindow = 25;
constexpr double kPeriods = 2.0;  // in the window, at least
constexpr double kSamplesAPeriod = 2.5;
constexpr double kTypicalOfMedian = 1.4826;
constexpr double kQuiet = 4.0;
constexpr std::size_t kFewest = 50;
constexpr double kStep = 0.25;  // of a period over the whole travel
constexpr std::ptrdiff_t kOnePeriod = 4;
constexpr double kHighestOrder = 40.0;
constexpr double kTwoPi = 2.0 * std::numbers::pi;

/// The quiet rows of a recording in which the joint turns one way.
struct Strokes {
  std::size_t segment = 0;
  ArrayXd angle, fast;
  double lowest = 0.0, highest = 0.0;  ///< orders that the rows can tell
  double sum_of_squares = 0.0;
  Index first = 0, last = 0;  ///< rows of the longest stroke
};

Strokes strokes_of(const Frame& frame, const ArrayXd& residual, std::size_t segment, double way) {
  const ArrayXd weights = parabola_weights(kHalfWindow);
  const Segment& s = frame.segments[segment];
  std::vector<double> angle, fast, size, speed;
  Index begin = s.first;  // of the stroke, its last row so far, and the longest one
  Index end = begin;
  std::pair<Index, Index> longest{begin, begin};
  for (Index r = s.first + kHalfWindow; r + kHalfWindow < s.first + s.count; ++r) {
    const auto window = Eigen::seqN(r - kHalfWindow, 2 * kHalfWindow + 1);
    if (frame.usable(window).minCoeff() == 0.0) continue;
    if ((way * frame.motor_speed(window)).minCoeff() <= 0.0) continue;
    angle.push_back(frame.motor_angle[r]);
    fast.push_back(residual[r] - (weights * residual(window)).sum());
    size.push_back(std::abs(fast.back()));
    speed.push_back(std::abs(frame.motor_speed[r]));
    if (r != end + 1) begin = r;
    end = r;
    if (end - begin > longest.second - longest.first) longest = {begin, end};
  }
  if (fast.size() < kFewest) return {};
  const double most = kQuiet * kTypicalOfMedian * middle(size);
  const double turned = middle(speed) * frame.interval / kTwoPi;
  Strokes strokes{.segment = segment,
                  .angle = {},
                  .fast = {},
                  .lowest = kPeriods / (turned * (2.0 * kHalfWindow + 1.0)),
                  .highest = 1.0 / (turned * kSamplesAPeriod)};
  std::vector<Index> rows;
  for (std::size_t k = 0; k < size.size(); ++k) {
    if (size[k] < most) rows.push_back(static_cast<Index>(k));
  }
  strokes.angle = Eigen::Map<ArrayXd>(angle.data(), static_cast<Index>(angle.size()))(rows);
  strokes.fast = Eigen::Map<ArrayXd>(fast.data(), static_cast<Index>(fast.size()))(rows);
  strokes.sum_of_squares = strokes.fast.square().sum();
  std::tie(strokes.first, strokes.last) = longest;
  return strokes;
}

std::vector<Strokes> all_strokes(const Frame& frame, const ArrayXd& residual) {
  std::vector<Strokes> list;
  for (std::size_t i = 0; i < frame.segments.size(); ++i) {
    for (const double way : {1.0, -1.0}) {
      Strokes one = strokes_of(frame, residual, i, way);
      if (one.sum_of_squares > 0.0) list.push_back(std::move(one));
    }
  }
  return list;
}

/// Fourier sums of all strokes at evenly spaced orders, from one to the next by a rotation.
class Spectrum {
 public:
  Spectrum(const Frame& frame, const std::vector<Strokes>& strokes, double first, double step)
      : frame_(frame), strokes_(strokes), order_(first), step_(step) {
    const std::complex<double> i(0.0, 1.0);
    for (const Strokes& one : strokes) {
      wave_.push_back((-i * first * one.angle.cast<std::complex<double>>()).exp());
      turn_.push_back((-i * step * one.angle.cast<std::complex<double>>()).exp());
    }
  }

  double order() const { return order_; }
  void advance() {
    order_ += step_;
    for (std::size_t k = 0; k < wave_.size(); ++k) wave_[k] *= turn_[k];
  }

  double amplitude(std::size_t k) const {
    const double rows = static_cast<double>(strokes_[k].fast.size());
    return 2.0 * std::abs((wave_[k] * strokes_[k].fast).sum()) / rows;
  }

  Ripple ripple(double colour) const {
    Ripple r{.order = order_};
    const Strokes* strongest = nullptr;
    double taken = 0.0;
    double all = 0.0;
    for (std::size_t k = 0; k < strokes_.size(); ++k) {
      const Strokes& one = strokes_[k];
      const double rows = static_cast<double>(one.fast.size());
      all += rows;
      if (order_ < one.lowest || order_ > one.highest) continue;
      const double a = amplitude(k);
      const double share = std::min(0.5 * rows * a * a / one.sum_of_squares, 1.0 - 1e-12);
      taken += rows * share;
      r.statistic -= rows / colour * std::log1p(-share) + 2.0 * std::log(rows);
      if (a > r.amplitude) r.amplitude = a, strongest = &one;
    }
    r.share = taken / all;
    if (strongest == nullptr) return r;
    r.segment = strongest->segment;
    r.from_s = frame_.time[strongest->first];
    r.to_s = frame_.time[strongest->last];
    return r;
  }

 private:
  const Frame& frame_;
  const std::vector<Strokes>& strokes_;
  double order_, step_;
  std::vector<ArrayXcd> wave_, turn_;
};

/// Every order that the strokes can tell, in quarters of a period over the whole travel.
std::vector<Ripple> spectrum_of(const Frame& frame, const std::vector<Strokes>& strokes,
                                double colour) {
  std::vector<Ripple> orders;
  if (strokes.empty()) return orders;
  const double first = std::ranges::min(strokes, {}, &Strokes::lowest).lowest;
  const double last =
      std::min(kHighestOrder, std::ranges::max(strokes, {}, &Strokes::highest).highest);
  const double step = kStep * resolved_order(frame);
  for (Spectrum spectrum(frame, strokes, first, step); spectrum.order() <= last;
       spectrum.advance()) {
    orders.push_back(spectrum.ripple(colour));
  }
  return orders;
}

// Whether the orders one to four periods of the travel away have less than half of it: what turns
// with the motor is a line, what changes slowly along the travel is not.
bool is_line(const std::vector<Ripple>& orders, std::ptrdiff_t at) {
  const double half = 0.5 * orders[static_cast<std::size_t>(at)].statistic;
  for (std::ptrdiff_t k = kOnePeriod; k <= 4 * kOnePeriod; ++k) {
    for (const std::ptrdiff_t i : {at - k, at + k}) {
      if (i < 0 || i >= std::ssize(orders)) return false;
      if (orders[static_cast<std::size_t>(i)].statistic > half) return false;
    }
  }
  return half > 0.0;
}

std::optional<Ripple> strongest_line(const std::vector<Ripple>& orders) {
  const auto best = std::ranges::max_element(orders, {}, &Ripple::statistic);
  if (best == orders.end() || !is_line(orders, best - orders.begin())) return std::nullopt;
  Ripple line = *best;
  line.statistic -= 2.0 * std::log(static_cast<double>(orders.size()));
  return line;
}

// A recording's own line, no further from an order found elsewhere than can be told apart.
std::optional<Ripple> line_near(const std::vector<Ripple>& orders, double order, double apart) {
  std::ptrdiff_t best = -1;
  for (std::ptrdiff_t i = 0; i < std::ssize(orders); ++i) {
    const Ripple& one = orders[static_cast<std::size_t>(i)];
    if (std::abs(one.order - order) > apart) continue;
    if (best < 0 || one.statistic > orders[static_cast<std::size_t>(best)].statistic) best = i;
  }
  if (best < 0 || !is_line(orders, best)) return std::nullopt;
  return orders[static_cast<std::size_t>(best)];
}

}  // namespace

double resolved_order(const Frame& frame) {
  return kTwoPi / (frame.motor_angle.maxCoeff() - frame.motor_angle.minCoeff());
}

std::optional<Ripple> ripple_left(const Frame& frame, const Findings& findings) {
  if (!frame.travels || !frame.has(Equation::torsion)) return std::nullopt;
  const std::size_t e = index_of(Equation::torsion);
  const auto strokes = all_strokes(frame, findings.fit.residual[e]);
  return strongest_line(spectrum_of(frame, strokes, findings.noise[e].colour));
}

std::optional<RippleProof> prove_ripple(const Frame& frame, const Findings& findings) {
  const std::size_t e = index_of(Equation::torsion);
  const double colour = findings.noise[e].colour;
  const auto strokes = all_strokes(frame, findings.fit.residual[e]);
  RippleProof proof;
  double before = 0.0;
  double after = 0.0;
  for (std::size_t i = 0; i < frame.segments.size(); ++i) {
    std::vector<Strokes> own;
    std::vector<Strokes> others;
    for (const Strokes& one : strokes) (one.segment == i ? own : others).push_back(one);
    const auto told = strongest_line(spectrum_of(frame, others, colour));
    if (!told || own.empty()) continue;
    const auto seen =
        line_near(spectrum_of(frame, own, colour), told->order, resolved_order(frame));
    if (!seen) continue;
    double squares = 0.0;
    for (const Strokes& one : own) squares += one.sum_of_squares;
    before += squares;
    after += squares * (1.0 - seen->share);
    proof.statistic += seen->statistic;
    proof.recordings.push_back(i);
  }
  if (proof.recordings.empty()) return std::nullopt;
  proof.ratio = std::sqrt(after / before);
  return proof;
}

}  // namespace flexspline::studies
