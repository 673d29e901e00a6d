// Return-point memory: which memory effects close their minor loops, and which do not.
#include <cmath>

#include <gtest/gtest.h>

#include "effect_paths.hpp"
#include "flexspline/core/effect_path.hpp"

namespace flexspline {
namespace {

/// A memory effect, the input that it remembers and a length that matters to it.
struct Memory {
  const char* effect;
  double Instant<double>::*input;
  double Instant<double>::*rate;
  double length;
};

constexpr Memory kTorsion{"", &Instant<double>::torsion, &Instant<double>::torsion_rate, 1e-3};
constexpr Memory kMotor{"", &Instant<double>::motor_angle, &Instant<double>::motor_speed, 0.06};
constexpr Memory kTorque{"", &Instant<double>::transmitted_torque,
                         &Instant<double>::transmitted_torque_rate, 15.0};

Memory named(const char* effect, Memory memory) {
  memory.effect = effect;
  return memory;
}

/// Straight from turn to turn, in units of its length and steps of 1/64, so slowly that speed plays
/// no part: a step a second.
std::vector<double> terms_of(const Memory& memory, const std::vector<double>& turns) {
  constexpr double kStep = 1.0 / 64.0;
  std::vector<Instant<double>> path(1);
  path[0].*memory.input = turns.front() * memory.length;
  for (std::size_t k = 1; k < turns.size(); ++k) {
    const double way = turns[k] - turns[k - 1];
    const int count = static_cast<int>(std::lround(std::abs(way) / kStep));
    for (int i = 1; i <= count; ++i) {
      Instant<double> x;
      x.time = static_cast<double>(path.size());
      x.*memory.input = (turns[k - 1] + way * i / count) * memory.length;
      x.*memory.rate = std::copysign(kStep, way) * memory.length;
      path.push_back(x);
    }
  }
  const auto row = find_effect(memory.effect);
  EXPECT_TRUE(row) << memory.effect;
  return *terms_along(**row, {memory.effect, nominal_parameters(**row)}, path);
}

/// How far the term is off, after a minor loop 0.5 -> 0.2 -> 0.5, from where it had left off; over
/// the whole way on to 2, as a share of the largest term.
double gap_after_minor_loop(const Memory& memory) {
  const auto straight = terms_of(memory, {0.0, 2.0, -2.0, 2.0});
  const auto detour = terms_of(memory, {0.0, 2.0, -2.0, 0.5, 0.2, 0.5, 2.0});
  double gap = 0.0;
  double most = 0.0;
  for (std::size_t i = 0; i <= 96; ++i) {  // from 0.5 to 2
    const double with = detour[detour.size() - 1 - i];
    const double without = straight[straight.size() - 1 - i];
    gap = std::max(gap, std::abs(with - without));
    most = std::max(most, std::abs(without));
  }
  return gap / most;
}

class MinorLoop : public testing::TestWithParam<Memory> {};
class OpenMinorLoop : public testing::TestWithParam<Memory> {};

TEST_P(MinorLoop, ClosesAndIsForgotten) { EXPECT_LT(gap_after_minor_loop(GetParam()), 1e-10); }

// What these rows say under not_modelled.
TEST_P(OpenMinorLoop, DoesNotClose) { EXPECT_GT(gap_after_minor_loop(GetParam()), 1e-4); }

const auto kName = [](const auto& param) { return std::string(param.param.effect); };

INSTANTIATE_TEST_SUITE_P(Stops, MinorLoop,
                         testing::Values(named("presliding_hysteresis", kTorsion),
                                         named("gms_friction", kMotor),
                                         named("play_backlash", kTorque)),
                         kName);

INSTANTIATE_TEST_SUITE_P(OneState, OpenMinorLoop,
                         testing::Values(named("bouc_wen", kTorsion),
                                         named("dahl_hysteresis", kTorsion),
                                         named("lugre_torsion", kTorsion),
                                         named("lugre_friction", kMotor)),
                         kName);

// Every row that remembers reversals stands in one of the lists above or has
// its memory in the sensor.
TEST(MinorLoops, AreTestedForEveryEffectOfReversalMemory) {
  const std::vector<std::string_view> tested = {
      "presliding_hysteresis", "gms_friction",  "play_backlash", "bouc_wen",
      "dahl_hysteresis",       "lugre_torsion", "lugre_friction"};
  for (const EffectRow& row : effects()) {
    if (row.coordinate != "reversal_memory" || row.states == 0 || on_instrument(row.site)) continue;
    EXPECT_NE(std::find(tested.begin(), tested.end(), row.id), tested.end()) << row.id;
  }
}

}  // namespace
}  // namespace flexspline
