#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <numbers>
#include <random>

#include <fmt/format.h>

#include <Eigen/Sparse>

#include "flexspline/core/counts.hpp"
#include "flexspline/core/cubic_basis.hpp"
#include "signals/banded.hpp"
#include "signals/smoothing.hpp"

namespace flexspline {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

constexpr std::size_t kFewestSamples = 16;
constexpr std::size_t kFewestIntervals = 4;
constexpr int kProbes = 6;

struct Knots {
  std::size_t samples_per_interval;
  std::size_t most_intervals;
  double cost;  ///< of a degree of freedom, in cross-validation
};

// At a cost of 1, with as many knots as samples, cross-validation now and then interpolates noise
// that is not white, as the counts of an encoder are.
Knots knots_of(Resolution resolution) {
  return resolution == Resolution::fine ? Knots{1, 20000, 1.1} : Knots{3, 3000, 1.0};
}

Sparse design(std::span<const double> time, const CubicBasis& basis) {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(4 * time.size());
  for (std::size_t i = 0; i < time.size(); ++i) {
    const auto local = basis.at(time[i]);
    for (std::size_t k = 0; k < 4; ++k) {
      entries.emplace_back(static_cast<int>(i), static_cast<int>(local.first + k), local.value[k]);
    }
  }
  Sparse matrix(static_cast<int>(time.size()), static_cast<int>(basis.size()));
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

Sparse third_differences(int size) {
  std::vector<Eigen::Triplet<double>> entries;
  const double weights[] = {-1.0, 3.0, -3.0, 1.0};
  for (int i = 0; i + 3 < size; ++i) {
    for (int k = 0; k < 4; ++k) entries.emplace_back(i, i + k, weights[k]);
  }
  Sparse matrix(size - 3, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

struct Penalised {
  Eigen::VectorXd coefficients;
  double score = std::numeric_limits<double>::infinity();
  double freedom = 0.0;
  double penalty = 0.0;
};

Eigen::MatrixXd random_signs(Eigen::Index rows) {
  std::mt19937_64 engine(20031);
  Eigen::MatrixXd signs(rows, kProbes);
  for (Eigen::Index i = 0; i < signs.size(); ++i) signs(i) = (engine() & 1) != 0 ? 1.0 : -1.0;
  return signs;
}

// The parts of the penalised equations that are the same for every penalty. The signals share them:
// only their right sides differ.
struct Equations {
  Equations(std::span<const double> time, const CubicBasis& splines,
            std::span<const std::span<const double>> signals);

  BandFactors with(double penalty) const { return BandFactors(normal + penalty * roughness); }

  Sparse basis;
  Band normal;
  Band roughness;
  Eigen::MatrixXd samples;  // a column a signal
  Rows right;               // products of the basis with the samples, then with random signs
};

Equations::Equations(std::span<const double> time, const CubicBasis& splines,
                     std::span<const std::span<const double>> signals)
    : basis(design(time, splines)), normal(band_of(basis.transpose() * basis)) {
  const Sparse differences = third_differences(static_cast<int>(splines.size()));
  roughness = band_of(differences.transpose() * differences);
  const auto rows = static_cast<Eigen::Index>(time.size());
  const auto count = static_cast<Eigen::Index>(signals.size());
  samples.resize(rows, count);
  right.resize(basis.cols(), count + kProbes);
  for (Eigen::Index s = 0; s < count; ++s) {
    const auto& signal = signals[static_cast<std::size_t>(s)];
    samples.col(s) = Eigen::Map<const Eigen::VectorXd>(signal.data(), rows);
    right.col(s) = basis.transpose() * samples.col(s);
  }
  right.rightCols(kProbes) = basis.transpose() * random_signs(rows);
}

// Generalised cross-validation of one penalty; the trace by random signs (Hutchinson). Keeps it for
// the signals whose best it is, or whose counts leave more than it does. Penalties rise.
void try_penalty(const Equations& equations, double penalty, double cost,
                 std::span<const double> of_counts, std::vector<Penalised>& best) {
  const Rows solved = equations.with(penalty).solve(equations.right);
  const double freedom =
      equations.right.rightCols(kProbes).cwiseProduct(solved.rightCols(kProbes)).sum() / kProbes;
  const double n = static_cast<double>(equations.samples.rows());
  const double left = n - cost * freedom;
  if (left < 1.0) return;
  for (std::size_t s = 0; s < best.size(); ++s) {
    const auto column = static_cast<Eigen::Index>(s);
    const Eigen::VectorXd coefficients = solved.col(column);
    const Eigen::VectorXd rest = equations.samples.col(column) - equations.basis * coefficients;
    const double square = rest.squaredNorm();
    const double score = square * n / (left * left);
    const bool follows_counts = square <= of_counts[s] * of_counts[s] * (n - freedom);
    if (score < best[s].score || follows_counts) best[s] = {coefficients, score, freedom, penalty};
  }
}

// The fit of one signal at a penalty that is given; what it takes of freedom is not asked for.
Penalised fit_at(const Equations& equations, double penalty, std::size_t signal) {
  const auto column = static_cast<Eigen::Index>(signal);
  return {.coefficients = equations.with(penalty).solve(equations.right.col(column)),
          .penalty = penalty};
}

SmoothSignal signal_of(const Penalised& fit, const CubicBasis& basis, std::span<const double> time,
                       std::span<const double> samples) {
  const std::size_t n = time.size();
  SmoothSignal signal{std::vector<double>(n), std::vector<double>(n), std::vector<double>(n), 0.0};
  double sum = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const auto local = basis.at(time[i]);
    for (std::size_t k = 0; k < 4; ++k) {
      const double c = fit.coefficients[static_cast<Eigen::Index>(local.first + k)];
      signal.value[i] += c * local.value[k];
      signal.rate[i] += c * local.slope[k];
      signal.second[i] += c * local.curvature[k];
    }
    sum += (samples[i] - signal.value[i]) * (samples[i] - signal.value[i]);
  }
  const double left = std::max(static_cast<double>(n) - fit.freedom, 1.0);
  signal.noise = std::sqrt(sum / left);
  signal.error.assign(n, signal.noise * std::sqrt(fit.freedom / static_cast<double>(n)));
  return signal;
}

// In the Fourier domain the equations of a coefficient are s + penalty (2 sin(w h/2))^6, s samples
// in an interval h, where w h is small; what turns faster than the knots can follow is not kept.
double bandwidth_of(double penalty, double samples_per_interval, double interval) {
  const double half = std::pow(samples_per_interval / penalty, 1.0 / 6.0);
  return std::min(half, std::numbers::pi) / interval;
}

SmoothSignal smoothed_by(const Penalised& fit, const CubicBasis& basis,
                         std::span<const double> time, std::span<const double> samples,
                         std::size_t intervals) {
  SmoothSignal smooth = signal_of(fit, basis, time, samples);
  const auto count = static_cast<double>(intervals);
  smooth.bandwidth = bandwidth_of(fit.penalty, static_cast<double>(time.size()) / count,
                                  (time.back() - time.front()) / count);
  return smooth;
}

// Root mean square over the samples within a span of time about each.
std::vector<double> running_rms(std::span<const double> time, const std::vector<double>& x,
                                double span) {
  std::vector<double> sums(x.size() + 1, 0.0), rms(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) sums[i + 1] = sums[i] + x[i] * x[i];
  std::size_t first = 0, last = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    while (time[first] < time[i] - span) ++first;
    while (last < x.size() && time[last] <= time[i] + span) ++last;
    const double sum = std::max(sums[last] - sums[first], 0.0);
    rms[i] = std::sqrt(sum / static_cast<double>(last - first));
  }
  return rms;
}

// Of every second sample, from the one given on.
std::vector<double> half_of(std::span<const double> samples, std::size_t first) {
  std::vector<double> half;
  for (std::size_t i = first; i < samples.size(); i += 2) half.push_back(samples[i]);
  return half;
}

// The signals by every second sample, behind the same filters, at the instants of all samples.
std::vector<SmoothSignal> smooth_half(std::span<const double> time,
                                      std::span<const std::span<const double>> signals,
                                      const std::vector<Penalised>& fits, std::size_t intervals,
                                      std::size_t first) {
  const CubicBasis basis(time.front(), time.back(), std::max(intervals / 2, kFewestIntervals));
  std::vector<std::vector<double>> samples;
  for (const auto& signal : signals) samples.push_back(half_of(signal, first));
  const std::vector<std::span<const double>> views(samples.begin(), samples.end());
  const Equations equations(half_of(time, first), basis, views);
  std::vector<SmoothSignal> smooth;
  for (std::size_t s = 0; s < fits.size(); ++s) {
    // Of twice the interval a 64th: the bandwidth stays.
    smooth.push_back(
        signal_of(fit_at(equations, fits[s].penalty / 64.0, s), basis, time, signals[s]));
  }
  return smooth;
}

// The larger of two, by sample, for value, rate and second derivative alike:
// 1. What changes with a ninth of the penalty: of what smoothing took of a motion eight ninths come
//    back. White noise passes H = 1/(1 + (w/bandwidth)^6); the integrals of w^2 (H_9 - H)^2 and of
//    w^2 H^2 over w are equal, so that noise changes a rate by as much as it makes it wrong (a
//    value by 0.42 times that, a second derivative by 1.76 times).
// 2. Half of the difference between the odd and the even samples' curves, the noise's own
//    deviation: what turns too fast for the samples differs between them.
void tell_errors(const Equations& equations, const std::vector<Penalised>& fits,
                 const CubicBasis& basis, std::span<const double> time,
                 std::span<const std::span<const double>> signals, std::size_t intervals,
                 std::vector<SmoothSignal>& smooth) {
  const auto even = smooth_half(time, signals, fits, intervals, 0);
  const auto odd = smooth_half(time, signals, fits, intervals, 1);
  for (std::size_t s = 0; s < fits.size(); ++s) {
    const SmoothSignal rough =
        signal_of(fit_at(equations, fits[s].penalty / 9.0, s), basis, time, signals[s]);
    const auto running = [&](const std::vector<double>& a, const std::vector<double>& b) {
      std::vector<double> change;
      std::ranges::transform(a, b, std::back_inserter(change), std::minus<>());
      return running_rms(time, change, 1.0 / smooth[s].bandwidth);
    };
    const auto error_of = [&](std::vector<double> SmoothSignal::*motion) {
      std::vector<double> error = running(rough.*motion, smooth[s].*motion);
      std::ranges::transform(
          running(even[s].*motion, odd[s].*motion), error, error.begin(),
          [](double halves, double ninth) { return std::max(0.5 * halves, ninth); });
      return error;
    };
    smooth[s].value_error = error_of(&SmoothSignal::value);
    smooth[s].rate_error = error_of(&SmoothSignal::rate);
    smooth[s].second_error = error_of(&SmoothSignal::second);
  }
}

// Behind bandwidths that are so many times narrower, on knots that are as many times farther apart:
// on the same ones the penalty, times the sixth power, outgrows what rounding leaves of the
// samples.
std::vector<SmoothSignal> narrowed(double times, std::vector<Penalised> fits,
                                   std::span<const double> time,
                                   std::span<const std::span<const double>> signals,
                                   std::size_t intervals) {
  const auto wanted = static_cast<std::size_t>(static_cast<double>(intervals) / times);
  const std::size_t wide = std::max<std::size_t>(wanted, kFewestIntervals);
  const double apart = static_cast<double>(intervals) / static_cast<double>(wide);
  const CubicBasis basis(time.front(), time.back(), wide);
  const Equations equations(time, basis, signals);
  std::vector<SmoothSignal> smooth;
  for (std::size_t s = 0; s < fits.size(); ++s) {
    fits[s] = fit_at(equations, apart * std::pow(times / apart, 6.0) * fits[s].penalty, s);
    smooth.push_back(smoothed_by(fits[s], basis, time, signals[s], wide));
  }
  tell_errors(equations, fits, basis, time, signals, wide, smooth);
  return smooth;
}

bool has_finite_squares(std::span<const double> samples) {
  double sum = 0.0;
  for (const double x : samples) sum += x * x;
  return std::isfinite(sum);
}

}  // namespace

Result<void> check_samples(std::span<const double> time,
                           std::span<const std::span<const double>> signals) {
  if (time.size() < kFewestSamples) {
    return failure(
        ErrorCode::numerics, fmt::format("{} samples", time.size()),
        fmt::format("{} or more are needed to separate signal from noise", kFewestSamples));
  }
  const bool increases = std::ranges::adjacent_find(time, std::not_fn(std::less<>())) == time.end();
  if (!increases || !std::isfinite(time.front()) || !std::isfinite(time.back())) {
    return failure(ErrorCode::numerics, "time does not increase from sample to sample",
                   "sort the samples, and drop those that repeat a time");
  }
  for (const auto& samples : signals) {
    if (samples.size() == time.size() && has_finite_squares(samples)) continue;
    return failure(ErrorCode::numerics, "samples are missing, not finite or overflow when squared",
                   "check the values and the unit of the channel");
  }
  return {};
}

Result<std::vector<SmoothSignal>> smooth_by_splines(
    std::span<const double> time, std::span<const std::span<const double>> signals,
    Resolution resolution, std::span<const double> narrower) {
  if (auto sound = check_samples(time, signals); !sound) return tl::unexpected(sound.error());
  const Knots knots = knots_of(resolution);
  const std::size_t intervals = std::clamp<std::size_t>(time.size() / knots.samples_per_interval,
                                                        kFewestIntervals, knots.most_intervals);
  const CubicBasis basis(time.front(), time.back(), intervals);
  const Equations equations(time, basis, signals);
  std::vector<double> of_counts;
  for (const auto& signal : signals) of_counts.push_back(deviation_of_counts(signal));
  std::vector<Penalised> best(signals.size());
  for (double exponent = -6.0; exponent <= 10.0; exponent += 0.5) {
    try_penalty(equations, std::pow(10.0, exponent), knots.cost, of_counts, best);
  }
  std::vector<SmoothSignal> smooth;
  for (std::size_t s = 0; s < signals.size(); ++s) {
    if (best[s].coefficients.size() == 0) {
      return failure(ErrorCode::numerics, "no smooth curve through the samples can be computed",
                     "check the values and the unit of the channel");
    }
    smooth.push_back(smoothed_by(best[s], basis, time, signals[s], intervals));
  }
  tell_errors(equations, best, basis, time, signals, intervals, smooth);
  for (const double times : narrower) {
    auto further = narrowed(times, best, time, signals, intervals);
    for (std::size_t s = 0; s < signals.size(); ++s) {
      smooth[s].narrower.push_back(
          {std::move(further[s].second), std::move(further[s].second_error), further[s].bandwidth});
    }
  }
  return smooth;
}

Result<SmoothSignal> smooth_by_spline(std::span<const double> time, std::span<const double> samples,
                                      Resolution resolution, std::span<const double> narrower) {
  auto smooth = smooth_by_splines(time, std::span(&samples, 1), resolution, narrower);
  if (!smooth) return tl::unexpected(smooth.error());
  return std::move(smooth->front());
}

}  // namespace flexspline
