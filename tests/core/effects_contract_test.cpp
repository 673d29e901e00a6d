// What every effect of the catalogue promises.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "effect_paths.hpp"
#include "flexspline/core/effect_path.hpp"

namespace flexspline {
namespace {

const std::set<std::string_view> kCoordinates = {
    "time", "torsion", "velocity",        "acceleration", "motor_angle", "load_angle",
    "load", "lag",     "reversal_memory", "temperature",  "constant"};

class EveryEffect : public testing::TestWithParam<std::size_t> {
 protected:
  const EffectRow& row() const { return effects()[GetParam()]; }
  EffectSpec nominal() const { return {std::string(row().id), nominal_parameters(row())}; }
  std::vector<double> terms(const std::vector<Instant<double>>& path) const {
    const auto along = terms_along(row(), nominal(), path);
    EXPECT_TRUE(along) << along.error().message();
    return along.value_or(std::vector<double>(path.size(), std::nan("")));
  }
};

double largest(const std::vector<double>& values) {
  double most = 0.0;
  for (double value : values) most = std::max(most, std::abs(value));
  return most;
}

TEST_P(EveryEffect, SaysWhatItIs) {
  EXPECT_THAT(kCoordinates, testing::Contains(row().coordinate));
  EXPECT_FALSE(row().equation.empty());
  EXPECT_FALSE(row().range.empty());
  EXPECT_FALSE(row().not_modelled.empty());
  EXPECT_FALSE(row().source.empty());
  EXPECT_EQ(row().active_because.empty(), row().passive) << "says why it may make energy";
  EXPECT_FALSE(row().rigs.empty());
  EXPECT_NE(name_of(row().site), "unknown");
  EXPECT_EQ(std::set(row().rigs.begin(), row().rigs.end()).size(), row().rigs.size());
  for (const char c : row().id) EXPECT_TRUE(c == '_' || std::islower(c) || std::isdigit(c)) << c;
}

// Units are SI symbols, as products and quotients of whole powers.
bool is_unit(std::string_view unit) {
  static const std::set<std::string_view> symbols = {"1", "rad", "Nm", "N", "s",  "kg",  "m", "A",
                                                     "V", "W",   "J",  "K", "Hz", "Ohm", "H"};
  std::size_t at = 0;
  while (at < unit.size()) {
    std::size_t end = unit.find_first_of(" /()", at);
    end = std::min(end, unit.size());
    std::string_view one = unit.substr(at, end - at);
    while (one.size() > 1 && std::isdigit(one.back())) one.remove_suffix(1);
    if (!one.empty() && one.back() == '^') one.remove_suffix(1);
    if (!one.empty() && !symbols.contains(one)) return false;
    at = end + 1;
  }
  return !unit.empty();
}

TEST_P(EveryEffect, HasParametersWithUnitBoundsNominalAndSource) {
  EXPECT_FALSE(row().parameters.empty());
  std::set<std::string_view> names;
  for (const EffectParameter& one : row().parameters) {
    EXPECT_TRUE(names.insert(one.name).second) << one.name << " stands twice";
    EXPECT_TRUE(is_unit(one.unit)) << one.name << " in '" << one.unit << "'";
    EXPECT_FALSE(one.source.empty()) << one.name;
    EXPECT_TRUE(std::isfinite(one.lower) && std::isfinite(one.upper)) << one.name;
    EXPECT_LT(one.lower, one.upper) << one.name;
    EXPECT_GE(one.nominal, one.lower) << one.name;
    EXPECT_LE(one.nominal, one.upper) << one.name;
  }
}

TEST_P(EveryEffect, IsThereForEveryScalar) {
  EXPECT_NE(row().real.term, nullptr);
  EXPECT_NE(row().dual.term, nullptr);
  EXPECT_NE(row().complex.term, nullptr);
  const bool memory = row().states > 0;
  EXPECT_EQ(row().real.advance != nullptr, memory);
  EXPECT_EQ(row().dual.advance != nullptr, memory);
  EXPECT_EQ(row().complex.advance != nullptr, memory);
  EXPECT_EQ(row().real.rate != nullptr, memory);
  EXPECT_EQ(row().dual.rate != nullptr, memory);
  EXPECT_EQ(row().complex.rate != nullptr, memory);
}

using Role = ParameterSearch::Role;

std::size_t count(const EffectRow& row, Role role) {
  return static_cast<std::size_t>(std::ranges::count(
      row.parameters, role, [](const EffectParameter& p) { return p.search.role; }));
}

TEST_P(EveryEffect, SaysOfEveryParameterHowItIsSoughtOrOfNone) {
  const std::size_t none = count(row(), Role::none);
  EXPECT_TRUE(none == 0 || none == row().parameters.size());
  EXPECT_EQ(sought_by_law(row()), none == 0);
  EXPECT_LE(count(row(), Role::sign_width), 1U);
  if (count(row(), Role::phase) > 0) {
    EXPECT_EQ(count(row(), Role::phase), 1U);
    EXPECT_EQ(count(row(), Role::linear), 1U) << "an amplitude to the phase";
  }
  for (const EffectParameter& one : row().parameters) {
    if (one.search.role != Role::shape) continue;
    EXPECT_GT(one.search.lower, 0.0) << one.name;
    EXPECT_LT(one.search.lower, one.search.upper) << one.name;
    EXPECT_FALSE(one.search.meaning.empty()) << one.name;
  }
  for (const Rig rig : row().sought_on) EXPECT_THAT(row().rigs, testing::Contains(rig));
}

std::vector<double> with(const EffectRow& row, std::vector<double> values, Role role,
                         double value) {
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (row.parameters[k].search.role == role) values[k] = value;
  }
  return values;
}

class SoughtEffect : public EveryEffect {};

// At every step of a path, memory included, twice the linear parameters are twice the term.
TEST_P(SoughtEffect, IsLinearInWhatItSaysItIs) {
  const auto path = drive_path(1.0, 400, 1);
  const auto along = [&](const std::vector<double>& values) {
    EffectSpec spec{std::string(row().id), {}};
    for (std::size_t k = 0; k < values.size(); ++k)
      spec.parameters.emplace_back(row().parameters[k].name, values[k]);
    return terms_along(row(), spec, path).value();
  };
  std::vector<double> values;
  for (const EffectParameter& one : row().parameters) values.push_back(one.nominal);
  const auto once = along(values);
  std::vector<double> doubled = values;
  for (std::size_t k = 0; k < values.size(); ++k)
    if (row().parameters[k].search.role == Role::linear) doubled[k] *= 2.0;
  const auto twice = along(doubled);
  const auto sine = along(with(row(), values, Role::phase, 0.0));
  const auto cosine = along(with(row(), values, Role::phase, std::numbers::pi / 2.0));
  const auto turned = along(with(row(), values, Role::phase, 0.7));
  for (std::size_t k = 0; k < path.size(); ++k) {
    EXPECT_NEAR(twice[k], 2.0 * once[k], 1e-12 * largest(once));
    if (count(row(), Role::phase) == 0) continue;
    EXPECT_NEAR(turned[k], std::cos(0.7) * sine[k] + std::sin(0.7) * cosine[k],
                1e-12 * (largest(sine) + largest(cosine)));
  }
}

// Offsets are an instrument's or, where a torque is one, not passive.
TEST_P(EveryEffect, IsSilentAtRest) {
  if (on_instrument(row().site) || !row().passive) GTEST_SKIP() << "may be off at rest";
  std::vector<Instant<double>> rest(5);
  for (std::size_t i = 0; i < rest.size(); ++i) {
    rest[i].time = 25.0 * static_cast<double>(i);
    rest[i].gear_ratio = 50.0;
  }
  for (double term : terms(rest)) EXPECT_EQ(term, 0.0);
}

TEST_P(EveryEffect, ShowsWhereThereIsMotion) {
  const auto path = drive_path(1.0, 400, 2);
  std::vector<double> signal;
  for (const auto& x : path) signal.push_back(x.transmitted_torque);
  const auto before = signal;
  ASSERT_TRUE(apply_along(row(), nominal(), path, signal));
  std::vector<double> change(signal.size());
  std::ranges::transform(signal, before, change.begin(), std::minus<>());
  EXPECT_TRUE(std::ranges::all_of(change, [](double c) { return std::isfinite(c); }));
  const bool angle = row().site == Site::kinematics || row().site == Site::motor_angle_signal ||
                     row().site == Site::load_angle_signal;
  EXPECT_GT(largest(change), angle ? 1e-8 : 1e-5);
}

/// What the term times gives the power lost. In the kinematics a gap loses -tau times the term's
/// rate, over a cycle the same as the term times tau'.
double partner_of(Site site, const Instant<double>& x) {
  if (site == Site::motor) return x.motor_speed;
  if (site == Site::kinematics) return x.transmitted_torque_rate;
  return site == Site::load ? x.load_speed : x.torsion_rate;
}

// The second of two equal cycles; the sum over equal steps of time is exact for what is smooth and
// periodic, so that conservative effects come out at rounding.
TEST_P(EveryEffect, MakesNoEnergyOverAClosedCycle) {
  if (on_instrument(row().site)) GTEST_SKIP() << "does no work";
  if (!row().passive) GTEST_SKIP() << row().active_because << ": effects_passivity_test";
  if (row().id == "backlash") GTEST_SKIP() << "of its own torque: effects_passivity_test";
  for (double period : {1.0, 30.0}) {
    constexpr std::size_t kPerCycle = 4000;
    const auto path = drive_path(period, kPerCycle, 2);
    const auto term = terms(path);
    double net = 0.0;
    double moved = 0.0;
    for (std::size_t i = kPerCycle; i < 2 * kPerCycle; ++i) {
      const double power = term[i] * partner_of(row().site, path[i]);
      net += power;
      moved += std::abs(power);
    }
    EXPECT_GT(moved, 0.0);
    EXPECT_GE(net, -1e-9 * moved) << "period " << period;
  }
}

TEST_P(EveryEffect, DoesNotKnowTheClockWhereItSaysSo) {
  if (!row().rate_independent) GTEST_SKIP() << "depends on rate";
  const auto once = terms(drive_path(1.0, 700, 2));
  const auto slower = terms(drive_path(7.0, 700, 2));
  EXPECT_THAT(slower, testing::Pointwise(testing::DoubleNear(1e-10 * largest(once)), once));
}

// 40 000 s in 40 equal cycles: past every time constant that an effect has.
TEST_P(EveryEffect, KeepsItsStatesBounded) {
  if (row().states == 0) GTEST_SKIP() << "has no memory";
  constexpr std::size_t kHalf = 20 * 400;
  const auto path = drive_path(1000.0, 400, 40);
  const auto values = parameter_values(row(), nominal());
  ASSERT_TRUE(values);
  std::vector<double> states(state_count(row(), values->size()), 0.0);
  double first = 0.0;
  double second = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    row().real.advance(path[i - 1], path[i], *values, states);
    for (double state : states) ASSERT_TRUE(std::isfinite(state)) << "at " << path[i].time << " s";
    double& most = i <= kHalf ? first : second;
    most = std::max(most, largest(states));
  }
  EXPECT_GT(first, 0.0);
  EXPECT_LE(second, 1.01 * first);
}

INSTANTIATE_TEST_SUITE_P(Catalogue, EveryEffect, testing::Range<std::size_t>(0, effects().size()),
                         [](const auto& param) { return std::string(effects()[param.param].id); });

std::vector<std::size_t> sought() {
  std::vector<std::size_t> list;
  for (std::size_t k = 0; k < effects().size(); ++k) {
    if (sought_by_law(effects()[k])) list.push_back(k);
  }
  return list;
}

INSTANTIATE_TEST_SUITE_P(Catalogue, SoughtEffect, testing::ValuesIn(sought()),
                         [](const auto& param) { return std::string(effects()[param.param].id); });

TEST(FindEffect, RefusesOneThatDoesNotExist) {
  const auto row = find_effect("backlash_of_the_third_kind");
  ASSERT_FALSE(row);
  EXPECT_THAT(row.error().message(), testing::HasSubstr("backlash_of_the_third_kind"));
}

}  // namespace
}  // namespace flexspline
