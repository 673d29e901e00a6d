#include <fmt/format.h>
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "flexspline/core/effect.hpp"
#include "hidden_fixture.hpp"

namespace flexspline::data {
namespace {

constexpr double kSize = 0.05;
constexpr Rig kRigs[] = {Rig::locked, Rig::free, Rig::specimen, Rig::servo};

struct Case {
  const HiddenRow* row;
  Rig rig;
};

std::vector<Case> cases(bool only_dissipating) {
  std::vector<Case> all;
  for (const HiddenRow& row : hidden_effects()) {
    if (only_dissipating && !row.dissipates) continue;
    for (const Rig rig : row.rigs) all.push_back({&row, rig});
  }
  return all;
}

const HiddenDataset& null_of(Rig rig) {
  static std::map<Rig, HiddenDataset> made;
  if (!made.contains(rig)) made[rig] = run_hidden_bench(small_bench(rig), {}).value();
  return made.at(rig);
}

/// Each row on each rig that shows it.
class HiddenRowTest : public testing::TestWithParam<Case> {
 protected:
  void SetUp() override {
    const auto made = run_hidden_bench(bench_, {{std::string(row().id), kSize}});
    ASSERT_TRUE(made) << made.error().message();
    data_ = *made;
  }
  const HiddenRow& row() const { return *GetParam().row; }
  Rig rig() const { return GetParam().rig; }

  HiddenBench bench_ = small_bench(GetParam().rig);
  HiddenDataset data_;
};

TEST_P(HiddenRowTest, HasItsShareInItsEquationAndOnlyThere) {
  const HiddenEquation own = hidden_equation(row().site, rig());
  const double share = imbalance(bench_, own, data_, null_of(rig()));
  RecordProperty("share", fmt::format("{:.4f}", share));
  EXPECT_NEAR(share / kSize, 1.0, 0.1);
  ASSERT_EQ(data_.answer.effects.size(), 1U);
  const HiddenFinding& told = data_.answer.effects[0];
  EXPECT_EQ(told.id, row().id);
  EXPECT_EQ(told.coordinate, row().coordinate);
  EXPECT_EQ(told.equation, own);
  EXPECT_NEAR(told.size_fraction / kSize, 1.0, 0.021);
  EXPECT_FALSE(told.parameters.empty());
  const bool is_sensor =
      row().site == HiddenSite::torque_sensor || row().site == HiddenSite::encoder;
  for (const HiddenEquation other : equations_of(rig())) {
    if (other == own || is_sensor) continue;
    // Through a gap or over a tooth the motor accelerates faster than samples resolve.
    if (other == HiddenEquation::motor && row().site == HiddenSite::transmission) continue;
    EXPECT_LT(imbalance(bench_, other, data_, null_of(rig())), 0.004) << name_of(other);
  }
}

TEST_P(HiddenRowTest, StartsAtRest) {
  // A channel's own constant, drift or ripple is there at rest, too.
  const bool of_channel = row().coordinate == "constant" || row().id == "torque_sensor_drift" ||
                          row().id == "variant:motor_crosstalk";
  for (const Recording& r : data_.ideal.recordings) {
    for (const auto& [quantity, values] : r.channels) {
      const bool torque =
          quantity == Quantity::motor_torque || quantity == Quantity::transmitted_torque;
      const double peak = largest(values);
      if (torque && of_channel) continue;
      EXPECT_LT(std::abs(values[0]), 1e-9 * peak) << r.id << " " << name_of(quantity);
      EXPECT_LT(std::abs(values[1]), 0.03 * peak) << r.id << " " << name_of(quantity);
    }
  }
}

/// Work of the imbalance along its shaft, J (of the drive: per turn of the load).
double work_of(const HiddenBench& bench, HiddenEquation equation, const Recording& with,
               const Recording& without, std::size_t from, std::size_t to) {
  const bool at_torsion = equation == HiddenEquation::torsion;
  const Differences x = at_torsion ? torsion_series(bench, with)
                                   : series(with, bench.rig == Rig::servo ? Quantity::load_angle
                                                                          : Quantity::motor_angle);
  std::vector<double> torque;
  if (equation == HiddenEquation::drive) {
    torque = with.channels.at(Quantity::motor_torque);
    const auto& base = without.channels.at(Quantity::motor_torque);
    for (std::size_t k = 0; k < torque.size(); ++k) torque[k] -= base[k];
  } else {
    torque = balance(bench, equation, with);
    torque.insert(torque.begin(), 2, 0.0);
  }
  double work = 0.0;
  for (std::size_t k = from; k < to; ++k) work += torque[k] * x.first(k) * x.step;
  return work;
}

class HiddenLossTest : public HiddenRowTest {};

TEST_P(HiddenLossTest, TakesEnergyFromAClosedCycle) {
  for (std::size_t i = 0; i < bench_.design.size(); ++i) {
    const HiddenExcitation& x = bench_.design[i];
    if (x.motion != HiddenMotion::sine) continue;
    const auto cycle = static_cast<std::size_t>(x.samples / x.cycles);
    const std::size_t from = cycle;
    const double work = work_of(bench_, data_.answer.effects[0].equation, data_.ideal.recordings[i],
                                null_of(rig()).ideal.recordings[i], from, from + cycle);
    EXPECT_GT(work, 0.0) << data_.ideal.recordings[i].id;
  }
}

TEST_P(HiddenRowTest, IsAbsentAtSizeZero) {
  const auto none = run_hidden_bench(bench_, {{std::string(row().id), 0.0}}).value();
  EXPECT_TRUE(same_bits(none.measured, null_of(rig()).measured));
  EXPECT_TRUE(none.answer.effects.empty());
  EXPECT_FALSE(same_bits(data_.measured, null_of(rig()).measured));
}

std::string label(const testing::TestParamInfo<Case>& chosen) {
  std::string name = fmt::format("{}_{}", chosen.param.row->id, name_of(chosen.param.rig));
  std::ranges::replace(name, ':', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(All, HiddenRowTest, testing::ValuesIn(cases(false)), label);
INSTANTIATE_TEST_SUITE_P(All, HiddenLossTest, testing::ValuesIn(cases(true)), label);

TEST(HiddenNull, BalancesOnEveryRig) {
  for (const Rig rig : kRigs) {
    for (const HiddenEquation equation : equations_of(rig)) {
      EXPECT_LT(imbalance(small_bench(rig), equation, null_of(rig), null_of(rig)), 0.002)
          << name_of(rig) << " " << name_of(equation);
    }
  }
}

TEST(HiddenCatalogue, HasEveryEffectOfTheContractAndThoseSoughtByTheirLaw) {
  const std::set<std::string_view> wanted = {"presliding_hysteresis",
                                             "viscoelastic_creep",
                                             "backlash",
                                             "direction_asymmetry",
                                             "stribeck_friction",
                                             "nonlinear_viscous_friction",
                                             "load_dependent_friction",
                                             "position_dependent_friction",
                                             "kinematic_error",
                                             "motor_torque_ripple",
                                             "gravity_load",
                                             "inertia_torque",
                                             "thermal_friction_drift",
                                             "torque_sensor_offset",
                                             "torque_sensor_drift",
                                             "sensor_delay",
                                             "motor_torque_offset",
                                             "torque_constant_error",
                                             "torque_sensor_gain",
                                             "series_compliance",
                                             "soft_windup",
                                             "encoder_skew",
                                             "encoder_eccentricity",
                                             "current_lag",
                                             "sensor_crosstalk"};
  std::set<std::string_view> have;
  for (const HiddenRow& row : hidden_effects()) {
    EXPECT_FALSE(row.equation.empty()) << row.id;
    EXPECT_FALSE(row.rigs.empty()) << row.id;
    if (hidden_class(row.id) == HiddenClass::named) have.insert(row.id);
    EXPECT_EQ(row.names.empty(), hidden_class(row.id) != HiddenClass::variant) << row.id;
    for (const std::string_view name : row.names) EXPECT_TRUE(wanted.contains(name)) << name;
  }
  for (const std::string_view id : have) {
    if (wanted.contains(id)) continue;
    const auto effect = find_effect(id);
    ASSERT_TRUE(effect) << id;
    EXPECT_TRUE(sought_by_law(**effect)) << id;
  }
  for (const std::string_view id : wanted) EXPECT_TRUE(have.contains(id)) << id;
}

TEST(HiddenCatalogue, HasSomethingUnknownAndAnIncidentForEveryBench) {
  for (const BenchKind kind : bench_kinds()) {
    std::map<HiddenClass, int> count;
    for (const HiddenRow& row : hidden_effects()) {
      if (row.shows_on(kind)) ++count[hidden_class(row.id)];
    }
    EXPECT_GE(count[HiddenClass::unknown], 2) << name_of(kind);
    EXPECT_EQ(count[HiddenClass::incident], 3) << name_of(kind);
  }
}

}  // namespace
}  // namespace flexspline::data
