#include "ode_fit/equation_error.hpp"

#include <algorithm>
#include <cmath>

#include "ode_fit/guess.hpp"
#include "ode_fit/smooth_states.hpp"
#include "solvers/least_squares.hpp"

namespace flexspline::estimators {
namespace {

constexpr double kKnownWeight = 1e4;      // of a known initial value against a measured one
constexpr std::size_t kMostPoints = 400;  // of an experiment
constexpr std::size_t kFewestSamples = 4;
constexpr std::size_t kPointsPerSample = 3;

// The smooth states of an experiment with their slopes at the collocated instants.
struct Curves {
  std::vector<double> time;
  std::vector<double> state;  // [instant][state]
  std::vector<double> slope;
  std::vector<double> initial;
};

std::optional<SmoothCurve> curve_of(const LaidOutExperiment& experiment, std::size_t state) {
  const auto output = output_that_shows(experiment, state);
  if (!output) return std::nullopt;
  const auto& source = experiment.source;
  const double gain =
      source.observation(static_cast<Eigen::Index>(*output), static_cast<Eigen::Index>(state));
  std::vector<double> time;
  std::vector<double> value;
  std::vector<double> weight;
  const bool known = experiment.initial[state].known();
  if (known) {
    time.push_back(source.start_time);
    value.push_back(experiment.initial[state].value);
    weight.push_back(kKnownWeight);
  }
  for (std::size_t k = 0; k < source.times.size(); ++k) {
    if (!experiment.counts(k, *output) || (known && source.times[k] == source.start_time)) continue;
    time.push_back(source.times[k]);
    value.push_back(source.measured[k * experiment.outputs() + *output] / gain);
    weight.push_back(1.0);
  }
  if (time.size() < kFewestSamples) return std::nullopt;
  return SmoothCurve(time, value, weight);
}

std::optional<Curves> curves_of(const LaidOutExperiment& experiment, std::size_t states) {
  std::vector<SmoothCurve> smooth;
  for (std::size_t i = 0; i < states; ++i) {
    auto one = curve_of(experiment, i);
    if (!one) return std::nullopt;
    smooth.push_back(std::move(*one));
  }
  Curves curves;
  const auto& times = experiment.source.times;
  const std::size_t points = std::min(kMostPoints, kPointsPerSample * times.size());
  const double from = times.front();
  for (std::size_t k = 0; k < points; ++k) {
    const double share = (static_cast<double>(k) + 0.5) / static_cast<double>(points);
    curves.time.push_back(from + share * (times.back() - from));
    for (const auto& one : smooth) {
      curves.state.push_back(one.value(curves.time.back()));
      curves.slope.push_back(one.slope(curves.time.back()));
    }
  }
  for (const auto& one : smooth) curves.initial.push_back(one.value(experiment.start_time()));
  return curves;
}

// Rate of the law less slope of the curve, an experiment a block, over the size of the slopes.
class EquationError final : public LeastSquaresProblem {
 public:
  EquationError(const OdeSystem& system, std::vector<Curves> curves)
      : system_(system), curves_(std::move(curves)), unit_(system.states(), 0.0) {
    for (const auto& one : curves_) {
      for (std::size_t k = 0; k < one.slope.size(); ++k) {
        double& unit = unit_[k % unit_.size()];
        unit = std::max(unit, std::abs(one.slope[k]));
      }
    }
    for (double& unit : unit_) unit = unit > 0.0 ? unit : 1.0;
  }

  std::size_t blocks() const override { return curves_.size(); }
  std::size_t residuals(std::size_t block) const override { return curves_[block].slope.size(); }

  Result<void> evaluate(std::size_t block, std::span<const double> p, std::span<double> residual,
                        std::span<double> jacobian) const override {
    const Curves& curves = curves_[block];
    const std::size_t states = unit_.size();
    std::vector<double> rate(states);
    for (std::size_t k = 0; k < curves.time.size(); ++k) {
      const auto y = std::span<const double>(curves.state).subspan(k * states, states);
      system_.rate(curves.time[k], y, p, rate);
      for (std::size_t i = 0; i < states; ++i) {
        residual[k * states + i] = (rate[i] - curves.slope[k * states + i]) / unit_[i];
        if (!std::isfinite(residual[k * states + i])) return tl::unexpected(not_a_number(p));
      }
      if (!jacobian.empty()) {
        differentiate(curves.time[k], y, p, jacobian.subspan(k * states * p.size()));
      }
    }
    return {};
  }

 private:
  void differentiate(double t, std::span<const double> y, std::span<const double> p,
                     std::span<double> jacobian) const {
    constexpr std::size_t kWidth = kMostDirections;
    const std::vector<Dual> state(y.begin(), y.end());
    std::vector<Dual> rate(y.size());
    for (std::size_t first = 0; first < p.size(); first += kWidth) {
      const std::size_t width = std::min(kWidth, p.size() - first);
      std::vector<Dual> dual(p.begin(), p.end());
      for (std::size_t k = 0; k < width; ++k) {
        dual[first + k] = Dual(p[first + k], static_cast<int>(width), static_cast<int>(k));
      }
      system_.rate(t, std::span<const Dual>(state), std::span<const Dual>(dual), std::span(rate));
      for (std::size_t i = 0; i < y.size(); ++i) {
        for (std::size_t k = 0; k < width; ++k) {
          jacobian[i * p.size() + first + k] = rate[i].slope(static_cast<int>(k)) / unit_[i];
        }
      }
    }
  }

  const OdeSystem& system_;
  std::vector<Curves> curves_;
  std::vector<double> unit_;
};

}  // namespace

std::optional<std::vector<double>> equation_error_start(const OdeLayout& layout) {
  std::vector<double> q = layout.start();
  std::vector<Curves> curves;
  for (const auto& experiment : layout.experiments) {
    auto one = curves_of(experiment, layout.states());
    if (!one) return std::nullopt;
    for (std::size_t i = 0; i < layout.states(); ++i) {
      const Source& source = experiment.initial[i];
      if (source.known()) continue;
      const auto& unknown = layout.unknowns[source.unknown];
      q[source.unknown] = std::clamp(one->initial[i], unknown.lower, unknown.upper);
    }
    curves.push_back(std::move(*one));
  }
  const std::size_t count = layout.system->parameters();
  if (count == 0) return q;
  std::vector<BoundedParameter> parameters;
  for (std::size_t k = 0; k < count; ++k) {
    const auto& u = layout.unknowns[k];
    parameters.push_back({u.start, u.lower, u.upper, u.scale});
  }
  const auto found = minimise(EquationError(*layout.system, std::move(curves)), parameters,
                              {.max_iterations = 100});
  if (!found) return std::nullopt;
  std::ranges::copy(found->p, q.begin());
  return q;
}

}  // namespace flexspline::estimators
