// What every law of the catalogue promises, and what each promises of its own.
#include <cmath>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "flexspline/core/law.hpp"
#include "flexspline/core/monotone_spline.hpp"
#include "law_examples.hpp"

namespace flexspline {
namespace {

using testing::HasSubstr;

// In units of the scale; none of them on a knot of an example.
const std::vector<double> kArguments = {-40.0, -2.5, -1.1,  -0.97, -0.62, -0.33, -0.013, -0.002,
                                        0.001, 0.02, 0.289, 0.46,  0.81,  0.99,  1.3,    25.0};

std::unique_ptr<Law> made(const LawSpec& spec) {
  auto law = make_law(spec);
  EXPECT_TRUE(law) << law.error().message();
  return std::move(*law);
}

double largest_slope(const Law& law) {
  double largest = 0.0;
  for (double u : kArguments) {
    if (std::abs(u) < 3.0) largest = std::max(largest, std::abs(law.slope(u * law.spec().scale)));
  }
  return largest;
}

class EveryLaw : public testing::TestWithParam<std::size_t> {
 protected:
  const LawRow& row() const { return laws()[GetParam()]; }
  const std::vector<LawSpec>& examples() const {
    const auto found = law_examples().find(std::string(row().id));
    static const std::vector<LawSpec> none;
    return found == law_examples().end() ? none : found->second;
  }
};

TEST_P(EveryLaw, SaysWhatItIs) {
  EXPECT_FALSE(row().equation.empty());
  EXPECT_FALSE(row().range.empty());
  EXPECT_FALSE(row().source.empty());
  EXPECT_FALSE(examples().empty()) << "law_examples.hpp has no example of " << row().id;
}

TEST_P(EveryLaw, HasTheSlopeOfItsValue) {
  for (const auto& spec : examples()) {
    const auto law = made(spec);
    const double typical = largest_slope(*law);
    const double step = 1e-7 * spec.scale;  // knots lie as close as 0.004
    for (double u : kArguments) {
      const double x = u * spec.scale;
      const double difference = (law->value(x + step) - law->value(x - step)) / (2.0 * step);
      const double size = std::max(typical, std::abs(difference));
      EXPECT_NEAR(law->slope(x), difference, 2e-7 * size) << row().id << " at " << u;
    }
  }
}

TEST_P(EveryLaw, HasTheGradientOfItsValue) {
  for (const auto& spec : examples()) {
    const auto law = made(spec);
    std::vector<double> gradient(spec.coefficients.size());
    for (double u : kArguments) {
      const double x = u * spec.scale;
      law->gradient(x, gradient);
      for (std::size_t k = 0; k < gradient.size(); ++k) {
        constexpr double kStep = 1e-4;
        LawSpec up = spec;
        LawSpec down = spec;
        up.coefficients[k] += kStep;
        down.coefficients[k] -= kStep;
        const double difference = (made(up)->value(x) - made(down)->value(x)) / (2.0 * kStep);
        const double rounding = 1e-11 * std::abs(law->value(x));
        EXPECT_NEAR(gradient[k], difference, 1e-6 * (1.0 + std::abs(difference)) + rounding)
            << row().id << " coefficient " << k << " at " << u;
      }
    }
  }
}

TEST_P(EveryLaw, GivesBackItsSpecification) {
  for (const auto& spec : examples()) {
    const auto law = made(spec);
    EXPECT_EQ(law->spec().law, row().id);
    EXPECT_EQ(law->spec().coefficients, spec.coefficients);
    EXPECT_EQ(law->spec().scale, spec.scale);
  }
}

TEST_P(EveryLaw, RefusesAScaleThatIsNotPositive) {
  for (LawSpec spec : examples()) {
    for (double scale : {0.0, -1.0, std::nan("")}) {
      spec.scale = scale;
      const auto law = make_law(spec);
      ASSERT_FALSE(law);
      EXPECT_EQ(law.error().code, ErrorCode::bad_data);
      EXPECT_THAT(law.error().message(), HasSubstr("scale"));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Catalogue, EveryLaw, testing::Range<std::size_t>(0, laws().size()),
                         [](const auto& param) { return std::string(laws()[param.param].id); });

class MonotoneSplines : public testing::Test {
 protected:
  std::vector<MonotoneSpline> splines() const {
    std::vector<MonotoneSpline> list;
    for (const auto& spec : law_examples().at("monotone_spline")) list.emplace_back(spec);
    return list;
  }
};

TEST_F(MonotoneSplines, IncreaseFromFarBelowToFarAbove) {
  for (const auto& spline : splines()) {
    const double s = spline.spec().scale;
    double last = -std::numeric_limits<double>::infinity();
    for (double u = -50.0; u <= 50.0; u += 0.0137) {
      const double y = spline.value(u * s);
      ASSERT_GT(y, last) << "at " << u;
      ASSERT_GT(spline.slope(u * s), 0.0) << "at " << u;
      last = y;
    }
    EXPECT_GT(spline.slope(1e6 * s), 0.0);
    EXPECT_GT(spline.slope(-1e6 * s), 0.0);
    EXPECT_EQ(spline.value(0.0), 0.0);
  }
}

TEST_F(MonotoneSplines, LeaveTheirRangeOnAStraightLine) {
  for (const auto& spline : splines()) {
    const double s = spline.spec().scale;
    for (double side : {-1.0, 1.0}) {
      const double slope = spline.slope(side * s);
      for (double u : {1.5, 3.0, 700.0}) {
        const double expected = spline.value(side * s) + slope * side * (u - 1.0) * s;
        EXPECT_NEAR(spline.value(side * u * s) / expected, 1.0, 1e-12);
      }
    }
  }
}

TEST_F(MonotoneSplines, AreUndoneByTheirInverse) {
  for (const auto& spline : splines()) {
    const double s = spline.spec().scale;
    for (double magnitude = 1e-6; magnitude < 1e4; magnitude *= 1.31) {
      for (double x : {magnitude * s, -magnitude * s}) {
        EXPECT_NEAR(spline.inverse(spline.value(x)), x, 1e-12 * std::max(std::abs(x), s));
      }
    }
    EXPECT_EQ(spline.inverse(0.0), 0.0);
  }
}

TEST_F(MonotoneSplines, AreOddWithOneSetOfCoefficients) {
  for (const auto& spline : splines()) {
    const double s = spline.spec().scale;
    bool mirrored = true;
    for (double u : {0.002, 0.3, 0.9, 4.0}) {
      mirrored = mirrored && spline.value(-u * s) == -spline.value(u * s);
    }
    EXPECT_EQ(mirrored, spline.odd());
    EXPECT_EQ(spline.odd(), spline.spec().coefficients.size() == spline.spec().knots.size() + 3);
  }
}

TEST(BoundedModulation, StaysWithinItsBoundsWhateverItsTerms) {
  std::mt19937_64 engine(3);
  std::normal_distribution<double> normal(0.0, 30.0);
  for (int draw = 0; draw < 50; ++draw) {
    const auto law = made(
        law_spec("bounded_modulation", 0.5, {}, {normal(engine), normal(engine), normal(engine)}));
    for (double x = -50.0; x <= 50.0; x += 0.37) {
      EXPECT_GE(law->value(x), std::exp(-1.5) * (1.0 - 1e-12));
      EXPECT_LE(law->value(x), std::exp(1.5) * (1.0 + 1e-12));
    }
    EXPECT_EQ(law->value(0.0), 1.0);
  }
}

TEST(BoundedModulation, IsNearlyTheExponentialWhereItIsSmall) {
  const auto law = made(law_spec("bounded_modulation", 2.0, {}, {0.01, 0.02}));
  // L tanh(p/L) = p - p^3/(3 L^2) + ...
  const double p = 0.01 * 0.8 + 0.02 * 0.64;
  EXPECT_NEAR(std::log(law->value(1.6)), p - p * p * p / 6.75, 1e-9);
}

struct Refusal {
  LawSpec spec;
  std::string names;
};

TEST(MakeLaw, RefusesWhatDoesNotFitTheLaw) {
  const std::vector<Refusal> refusals = {
      {law_spec("cubic", 1.0, {}, {1.0}), "'cubic'"},
      {law_spec("odd_polynomial", 1.0, {}, {}), "no coefficients"},
      {law_spec("monotone_spline", 1.0, {0.5}, {1.0, 2.0, 3.0}), "1 knots has 3 coefficients"},
      {law_spec("monotone_spline", 1.0, {0.6, 0.5}, {1.0, 2.0, 3.0, 4.0, 5.0}), "knot 0.5 after"},
      {law_spec("monotone_spline", 1.0, {0.5, 1.0}, {1.0, 2.0, 3.0, 4.0, 5.0}), "knot 1"},
      {law_spec("monotone_spline", 1.0, {0.0}, {1.0, 2.0, 3.0, 4.0}), "knot 0"},
      {law_spec("monotone_spline", 1.0, {std::nan("")}, {1.0, 2.0, 3.0, 4.0}), "knot nan"},
      {law_spec("power_law", 1.0, {}, {1.0}), "1 coefficients"},
      {law_spec("power_law", 1.0, {}, {1.0, 0.1}), "exponent 0.1"},
      {law_spec("free_spline", 1.0, {0.5}, {1.0, 2.0, 3.0, 4.0}), "1 knots"},
      {law_spec("free_spline", 1.0, {0.5, 0.5}, {1.0, 2.0, 3.0, 4.0}), "free_spline"},
      {law_spec("free_spline", 1.0, {-1.0, 1.0}, {1.0, 2.0, 3.0}), "3 coefficients"},
  };
  for (const auto& [spec, names] : refusals) {
    const auto law = make_law(spec);
    ASSERT_FALSE(law) << names;
    EXPECT_EQ(law.error().code, ErrorCode::bad_data);
    EXPECT_THAT(law.error().problem, HasSubstr(names));
    EXPECT_FALSE(law.error().remedy.empty());
  }
}

}  // namespace
}  // namespace flexspline
