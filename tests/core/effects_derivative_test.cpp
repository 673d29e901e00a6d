// An effect's derivatives: duals against the complex step and central differences; rate against
// advance.
#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "effect_paths.hpp"

namespace flexspline {
namespace {

constexpr std::size_t kFields = instant_fields<double>().size();
constexpr int kPoints = 40;
constexpr double kSteps[] = {1e-4, 1e-5, 1e-6};  ///< relative to the input

/// What an effect's function takes, all in one row: fields of one or two instants, parameters,
/// states.
struct Inputs {
  std::vector<double> values;
  std::size_t instants = 1;
  std::size_t parameters = 0;
};

std::string name_of_input(const EffectRow& row, const Inputs& inputs, std::size_t j) {
  const std::size_t fields = inputs.instants * kFields;
  if (j < fields) return instant_fields<double>()[j % kFields].name;
  if (j < fields + inputs.parameters) {
    return std::string(row.parameters[(j - fields) % row.parameters.size()].name);
  }
  return "state";
}

template <class S>
Instant<S> instant_at(std::span<const S> fields) {
  Instant<S> x;
  for (std::size_t k = 0; k < kFields; ++k) x.*instant_fields<S>()[k].member = fields[k];
  return x;
}

template <class S>
const EffectFunctions<S>& functions(const EffectRow& row) {
  if constexpr (std::is_same_v<S, double>)
    return row.real;
  else if constexpr (std::is_same_v<S, Dual>)
    return row.dual;
  else
    return row.complex;
}

/// The term for one instant; for two, the states after advancing from one to the other.
template <class S>
std::vector<S> outputs(const EffectRow& row, const Inputs& shape, const std::vector<S>& values) {
  const std::span<const S> all(values);
  const auto parameters = all.subspan(shape.instants * kFields, shape.parameters);
  const auto given = all.subspan(shape.instants * kFields + shape.parameters);
  const auto from = instant_at<S>(all.first(kFields));
  if (shape.instants == 1) return {functions<S>(row).term(from, parameters, given)};
  std::vector<S> states(given.begin(), given.end());
  functions<S>(row).advance(from, instant_at<S>(all.subspan(kFields, kFields)), parameters, states);
  return states;
}

std::vector<double> at(const EffectRow& row, const Inputs& x, std::size_t j, double step) {
  auto values = x.values;
  values[j] += step;
  return outputs<double>(row, x, values);
}

std::vector<double> by_dual(const EffectRow& row, const Inputs& x, std::size_t j) {
  std::vector<Dual> values(x.values.begin(), x.values.end());  // the others are constants
  values[j] = Dual(x.values[j], 1, 0);
  std::vector<double> slopes;
  const auto plain = at(row, x, j, 0.0);
  for (const Dual& out : outputs<Dual>(row, x, values)) {
    EXPECT_NEAR(out.value(), plain[slopes.size()], 1e-12 * std::abs(out.value()));
    slopes.push_back(out.slope(0));
  }
  return slopes;
}

std::vector<double> by_complex_step(const EffectRow& row, const Inputs& x, std::size_t j) {
  constexpr double kTiny = 1e-100;
  std::vector<Complex> values(x.values.begin(), x.values.end());
  values[j] += Complex(0.0, kTiny);
  std::vector<double> slopes;
  for (const Complex& out : outputs<Complex>(row, x, values)) slopes.push_back(out.imag() / kTiny);
  return slopes;
}

/// Whether the derivative jumps or turns sharply within the largest step.
bool near_kink(const EffectRow& row, const Inputs& x, std::size_t j, std::size_t out) {
  const double step = kSteps[0] * std::abs(x.values[j]);
  auto moved = x;
  moved.values[j] += step;
  const double after = by_complex_step(row, moved, j)[out];
  moved.values[j] -= 2.0 * step;
  const double before = by_complex_step(row, moved, j)[out];
  return std::abs(after - before) > 0.02 * (std::abs(after) + std::abs(before));
}

void expect_central_differences(const EffectRow& row, const Inputs& x, std::size_t j,
                                std::size_t out, double slope) {
  const double size = std::abs(x.values[j]);
  double previous = std::numeric_limits<double>::infinity();
  for (double relative : kSteps) {
    const double step = relative * size;
    const double up = at(row, x, j, step)[out];
    const double down = at(row, x, j, -step)[out];
    const double error = std::abs((up - down) / (2.0 * step) - slope);
    const double rounding = 1e-15 * (std::abs(up) + std::abs(down)) / step;
    EXPECT_LE(error, 0.05 * previous + 20.0 * rounding + 1e-8 * std::abs(slope))
        << row.id << " by " << name_of_input(row, x, j) << " at step " << relative;
    previous = error;
  }
  EXPECT_LE(previous, 1e-5 * std::abs(slope) + 2e-8 * std::abs(at(row, x, j, 0.0)[out]) / size)
      << row.id << " by " << name_of_input(row, x, j);
}

class EveryDerivative : public testing::TestWithParam<std::size_t> {
 protected:
  const EffectRow& row() const { return effects()[GetParam()]; }

  /// Two instants lie so close together that no law takes more than one step between them.
  Inputs random_inputs(std::mt19937_64& draw, std::size_t instants) const {
    Inputs inputs{{}, instants, 0};
    auto x = random_instant(draw);
    const auto parameters = scattered_parameters(row(), draw);
    const auto states = random_states(row(), parameters, draw);
    for (std::size_t k = 0; k < instants; ++k) {
      for (const auto& field : instant_fields<double>()) {
        inputs.values.push_back(x.*field.member);
      }
      x = moved(x, 1e-3);
    }
    inputs.parameters = parameters.size();
    inputs.values.insert(inputs.values.end(), parameters.begin(), parameters.end());
    inputs.values.insert(inputs.values.end(), states.begin(), states.end());
    return inputs;
  }

  void expect_derivatives(std::size_t instants) const {
    std::mt19937_64 draw(20240607);
    int smooth = 0;
    int tried = 0;
    for (int point = 0; point < kPoints && !HasFailure(); ++point) {
      const Inputs x = random_inputs(draw, instants);
      for (std::size_t j = 0; j < x.values.size(); ++j) {
        const auto duals = by_dual(row(), x, j);
        const auto steps = by_complex_step(row(), x, j);
        for (std::size_t out = 0; out < duals.size(); ++out) {
          EXPECT_NEAR(duals[out], steps[out], 1e-9 * std::abs(steps[out]) + 1e-300)
              << row().id << " by " << name_of_input(row(), x, j);
          ++tried;
          if (near_kink(row(), x, j, out)) continue;
          ++smooth;
          expect_central_differences(row(), x, j, out, duals[out]);
        }
      }
    }
    EXPECT_GT(2 * smooth, tried) << "too few points without a kink";
  }
};

TEST_P(EveryDerivative, OfTheTermIsExact) { expect_derivatives(1); }

TEST_P(EveryDerivative, OfTheMemoryIsExact) {
  if (row().states == 0) GTEST_SKIP() << "has no memory";
  expect_derivatives(2);
}

TEST_P(EveryDerivative, RateAndAdvanceAgreeToSecondOrder) {
  if (row().states == 0) GTEST_SKIP() << "has no memory";
  std::mt19937_64 draw(77);
  for (int point = 0; point < kPoints; ++point) {
    const auto x = random_instant(draw);
    const auto parameters = scattered_parameters(row(), draw);
    const auto states = random_states(row(), parameters, draw);
    std::vector<double> rates(states.size());
    row().real.rate(x, parameters, states, rates);
    std::vector<double> error[2];
    const double steps[] = {1e-5, 1e-6};
    for (int k = 0; k < 2; ++k) {
      auto after = states;
      row().real.advance(x, moved(x, steps[k]), parameters, after);
      for (std::size_t i = 0; i < states.size(); ++i) {
        error[k].push_back(std::abs(after[i] - states[i] - steps[k] * rates[i]));
      }
    }
    for (std::size_t i = 0; i < states.size(); ++i) {
      EXPECT_LE(error[1][i], 0.02 * error[0][i] + 1e-7 * std::abs(steps[1] * rates[i]) +
                                 1e-15 * std::abs(states[i]))
          << row().id << " state " << i << ", rate " << rates[i];
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Catalogue, EveryDerivative,
                         testing::Range<std::size_t>(0, effects().size()),
                         [](const auto& param) { return std::string(effects()[param.param].id); });

}  // namespace
}  // namespace flexspline
