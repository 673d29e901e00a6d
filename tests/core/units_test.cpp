#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "flexspline/core/recording.hpp"
#include "flexspline/core/units.hpp"

namespace flexspline {
namespace {

double si(std::string_view symbol, double value) { return to_si(find_unit(symbol).value(), value); }

TEST(Units, AgreeWithTheirDefinitions) {
  EXPECT_DOUBLE_EQ(si("deg", 180.0), std::numbers::pi);
  EXPECT_DOUBLE_EQ(si("arcmin", 60.0), si("deg", 1.0));
  EXPECT_DOUBLE_EQ(si("arcsec", 3600.0), si("deg", 1.0));
  EXPECT_DOUBLE_EQ(si("rev", 1.0), si("deg", 360.0));
  EXPECT_DOUBLE_EQ(si("rpm", 60.0), 2.0 * std::numbers::pi);
  EXPECT_DOUBLE_EQ(si("kNm", 1.0), si("mNm", 1e6));
  EXPECT_DOUBLE_EQ(si("in", 1.0), si("mm", 25.4));
  EXPECT_DOUBLE_EQ(si("lbf", 1.0), 4.4482216152605);
  EXPECT_DOUBLE_EQ(si("degC", 0.0), 273.15);
  EXPECT_NEAR(si("degF", 212.0), si("degC", 100.0), 1e-12);
}

TEST(Units, ConvertBackToWhatWasWritten) {
  for (const Unit& unit : units()) {
    EXPECT_NEAR(from_si(unit, to_si(unit, 7.25)), 7.25, 1e-12) << unit.symbol;
  }
}

TEST(Units, HaveEachSymbolOnceAndOneOfSiForEachDimension) {
  std::set<std::string_view> symbols;
  std::set<Dimension> with_si;
  std::set<Dimension> all;
  for (const Unit& unit : units()) {
    EXPECT_TRUE(symbols.insert(unit.symbol).second) << unit.symbol;
    all.insert(unit.dimension);
    if (unit.factor == 1.0 && unit.offset == 0.0) with_si.insert(unit.dimension);
  }
  EXPECT_EQ(all, with_si);
  EXPECT_EQ(all.size(), 12U);
}

TEST(Units, OfMotionHaveTheirRates) {
  for (const Unit& unit : units()) {
    if (unit.dimension != Dimension::angle && unit.dimension != Dimension::length) continue;
    const auto rate = find_unit(std::string(unit.symbol) + "/s");
    ASSERT_TRUE(rate.has_value()) << unit.symbol;
    EXPECT_DOUBLE_EQ(rate->factor, unit.factor) << unit.symbol;
  }
}

TEST(Units, AreFoundByTheExactSymbolOnly) {
  EXPECT_FALSE(find_unit("Deg").has_value());
  EXPECT_FALSE(find_unit("").has_value());
  EXPECT_THAT(symbols_of(Dimension::torque), testing::HasSubstr("Nm, mNm, kNm"));
  EXPECT_EQ(name_of(Dimension::temperature), "temperature");
  EXPECT_EQ(name_of(Dimension::angular_velocity), "angular velocity");
}

TEST(Quantities, AreFoundByTheirNames) {
  EXPECT_EQ(quantities().size(), 19U);
  for (const QuantityInfo& info : quantities()) {
    EXPECT_EQ(find_quantity(info.name), info.quantity);
    EXPECT_EQ(name_of(info.quantity), info.name);
    EXPECT_FALSE(info.dimensions.empty()) << info.name;
  }
  EXPECT_FALSE(find_quantity("motor angle").has_value());
}

TEST(Rigs, AreFoundByTheirNames) {
  for (const Rig rig : {Rig::locked, Rig::free, Rig::specimen, Rig::servo}) {
    EXPECT_EQ(find_rig(name_of(rig)), rig);
  }
  EXPECT_FALSE(find_rig("Locked").has_value());
}

}  // namespace
}  // namespace flexspline
