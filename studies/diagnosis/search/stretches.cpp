#include "diagnosis/search/stretches.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "diagnosis/frame/middle.hpp"
#include "diagnosis/frame/running.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

constexpr double kMedianSize = 0.6745;  // of a standard normal
constexpr double kOutlying = 4.0;  // standard deviations: a single row is worth eight nats at most
constexpr Index kHalfWindow = 25;  // of the parabola about which a pulse stands, as the noise's
constexpr std::array kShares = {0.01, 0.025, 0.05, 0.1};  // of a recording: lengths of a stretch
constexpr std::array kPulses = {0.005, 0.0075, 0.01, 0.015};
constexpr Index kFewest = 6;    // rows of a stretch
constexpr Index kShortest = 4;  // rows of a pulse

double usual_size(const ArrayXd& z) {
  std::vector<double> sizes;
  for (const double value : z) {
    if (value != 0.0) sizes.push_back(std::abs(value));
  }
  return sizes.empty() ? 0.0 : middle(std::move(sizes)) / kMedianSize;
}

double usual_value(const ArrayXd& z) { return middle({z.begin(), z.end()}); }

// Log likelihood of a variance of its own, where it is larger than the recording's.
double power_nats(double mean_square, double rows) {
  if (!(mean_square > 1.0)) return 0.0;
  return 0.5 * rows * (mean_square - 1.0 - std::log(mean_square));
}

/// The best of some stretches of a recording, all at corners of its motion or none.
class Best {
 public:
  Best(const Corners& corners, bool at_corners) : corners_(corners), at_corners_(at_corners) {}

  /// further: rows beside it that have a say in it.
  void take(double nats, Index first, Index count, Index further = 0) {
    if (corners_.touched(first, count, further) != at_corners_) return;
    tried_.push_back({nats, first, count, 0.0});
  }

  Stretch found() const {
    Stretch best;
    for (const Stretch& s : tried_) {
      if (s.nats > best.nats) best = s;
    }
    const auto apart = static_cast<Index>(kApart * static_cast<double>(corners_.rows()));
    for (const Stretch& s : tried_) {
      const bool far =
          s.first >= best.first + best.count + apart || s.first + s.count + apart <= best.first;
      if (far) best.elsewhere = std::max(best.elsewhere, s.nats);
    }
    return best;
  }

 private:
  const Corners& corners_;
  bool at_corners_;
  std::vector<Stretch> tried_;
};

void by_power(const ArrayXd& z, Best& best) {
  const ArrayXd sum = running_sum(z.max(-kOutlying).min(kOutlying).square());
  const Index n = z.size();
  for (const double share : kShares) {
    const Index width = std::max(kFewest, static_cast<Index>(share * static_cast<double>(n)));
    const double rows = static_cast<double>(width);
    for (Index i = 0; i + width <= n; i += std::max<Index>(1, width / 4)) {
      best.take(power_nats((sum[i + width] - sum[i]) / rows, rows), i, width);
    }
  }
}

// Long-run variance over variance, at least 1 (Newey and West 1987): by how much means of rows that
// follow each other scatter more than those of independent ones. The estimators' own ratio ends at
// forty lags, which what a model misses outlasts.
double long_run(const ArrayXd& z, Index lags) {
  double sum = z.square().sum();
  const double variance = sum;
  for (Index k = 1; k <= lags && k < z.size(); ++k) {
    const double weight = 1.0 - static_cast<double>(k) / static_cast<double>(lags + 1);
    sum += 2.0 * weight * (z.head(z.size() - k) * z.tail(z.size() - k)).sum();
  }
  return variance > 0.0 ? std::max(1.0, sum / variance) : 1.0;
}

// A mean from one row to the end that is another than before, held against how means of what is
// left beside the two wander: what a model misses is no step.
Stretch by_step(const ArrayXd& z) {
  const Index n = z.size();
  const ArrayXd sum = running_sum(z);
  const auto total = static_cast<double>(n);
  Stretch best;
  for (Index i = n / 10; i + n / 10 < n; ++i) {
    const auto before = static_cast<double>(i);
    const double contrast = sum[i] / before - (sum[n] - sum[i]) / (total - before);
    const double nats = 0.5 * contrast * contrast * before * (total - before) / total;
    if (nats > best.nats) best = {nats, i, n - i, 0.0};
  }
  if (best.count == 0) return best;
  ArrayXd about = z;
  auto later = about.tail(best.count);
  auto earlier = about.head(n - best.count);
  const double late = usual_value(later);
  const double early = usual_value(earlier);
  later -= late, earlier -= early;
  const double usual = usual_size(about);
  if (!(usual > 0.0)) return {};
  about = (about / usual).max(-kOutlying).min(kOutlying);
  const double contrast = (late - early) / usual + later.mean() - earlier.mean();
  const auto after = static_cast<double>(best.count);
  best.nats = 0.5 * contrast * contrast * after * (total - after) / total / long_run(about, n / 10);
  return best;
}

// A few rows beside the rest: their mean over that of as many rows anywhere in the recording.
void by_pulse(const ArrayXd& residual, Best& best) {
  const ArrayXd about = about_parabola(residual, parabola_weights(kHalfWindow));
  const double usual = usual_size(about);
  if (!(usual > 0.0)) return;
  const ArrayXd sum = running_sum((about / usual).max(-kOutlying).min(kOutlying));
  for (const double share : kPulses) {
    const Index width =
        std::max(kShortest, static_cast<Index>(share * static_cast<double>(residual.size())));
    const Index count = about.size() - width;
    if (count < 1) continue;
    const ArrayXd means = sum.segment(width, count) - sum.head(count);
    const double spread = std::max(usual_size(means), std::sqrt(static_cast<double>(width)));
    for (Index i = 0; i < count; ++i) {
      const double z = (sum[i + width] - sum[i]) / spread;
      best.take(0.5 * z * z, i + kHalfWindow, width, kHalfWindow);
    }
  }
}

}  // namespace

Scans::Scans(const Frame& frame, const std::vector<Corners>& corners, const Findings& findings,
             Equation equation)
    : frame_(frame),
      corners_(corners),
      weighted_(findings.fit.residual[index_of(equation)] * findings.weight[index_of(equation)] *
                motion_is_known(frame, findings.noise[index_of(equation)])),
      at_corners_(usual_size(weighted_ * corner_rows())) {}

double Scans::usual() const { return usual_size(weighted_); }

template <class By>
std::vector<Stretch> Scans::each(const By& by) const {
  std::vector<Stretch> list;
  for (std::size_t i = 0; i < frame_.segments.size(); ++i) list.push_back(by(i));
  return list;
}

ArrayXd Scans::of_recording(const ArrayXd& rows, std::size_t i) const {
  return rows.segment(frame_.segments[i].first, frame_.segments[i].count);
}

// Over the recording's usual size, or a larger one.
ArrayXd Scans::normal(std::size_t i, double least) const {
  const ArrayXd z = of_recording(weighted_, i);
  const double usual = std::max(usual_size(z), least);
  return usual > 0.0 ? ArrayXd(z / usual) : z;
}

ArrayXd Scans::corner_rows() const {
  ArrayXd rows = ArrayXd::Zero(frame_.rows());
  for (std::size_t i = 0; i < frame_.segments.size(); ++i) {
    const Segment& s = frame_.segments[i];
    for (Index r = 0; r < s.count; ++r) rows[s.first + r] = corners_[i].at(r) ? 1.0 : 0.0;
  }
  return rows;
}

std::vector<Scan> Scans::all() const {
  std::vector<Scan> list = {
      {each([this](std::size_t i) { return by_step(of_recording(weighted_, i)); }),
       Scan::Of::steps}};
  for (const bool at_corners : {false, true}) {
    const auto best_of = [&](const auto& by) {
      return each([&](std::size_t i) {
        Best best(corners_[i], at_corners);
        by(i, best);
        return best.found();
      });
    };
    const double least = at_corners ? at_corners_ : 0.0;
    const auto power = [&](std::size_t i, Best& best) { by_power(normal(i, least), best); };
    const auto pulse = [&](std::size_t i, Best& best) {
      by_pulse(of_recording(weighted_, i), best);
    };
    const auto of = at_corners ? Scan::Of::corners : Scan::Of::plain;
    list.push_back({best_of(power), of});
    list.push_back({best_of(pulse), of});
  }
  return list;
}

}  // namespace flexspline::studies
