#include "trial/effect_trace.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "flexspline/data/hidden_bench.hpp"

namespace flexspline::studies {
namespace {

struct Traced {
  ConcealedAnswer answer;
  std::vector<EffectTrace> traces;
};

Traced traced(const std::vector<data::HiddenEffect>& effects,
              const std::map<std::string, double>& nuisances = {}) {
  ConcealPlan plan;
  plan.seed = 5;
  plan.effects = effects;
  plan.nuisances = nuisances;
  const auto concealed = conceal(plan);
  EXPECT_TRUE(concealed) << concealed.error().message();
  auto traces = traces_of(plan, concealed->recordings);
  EXPECT_TRUE(traces) << traces.error().message();
  return {concealed->answer, *std::move(traces)};
}

// Half of a friction in one direction is Coulomb friction, which the odd damper takes up; the other
// half is a constant, which nothing does.
TEST(EffectTrace, OfAFrictionInOneDirectionIsHalfOfIt) {
  const Traced one = traced({{"direction_asymmetry", 0.05}});
  ASSERT_EQ(one.traces.size(), 1U);
  EXPECT_EQ(one.traces[0].effect, "direction_asymmetry");
  EXPECT_NEAR(one.traces[0].share, 0.5 * one.answer.effects[0].size_fraction, 0.002);
}

// A spring in series is a softer spring: f takes it up whole.
TEST(EffectTrace, OfAComplianceInSeriesIsNextToNothing) {
  const Traced one = traced({{"series_compliance", 0.05}});
  ASSERT_EQ(one.traces.size(), 1U);
  EXPECT_LT(one.traces[0].share, 0.004);
}

// It is no matter of the noise, which is the same with the effect and without; how far it stands
// out of the noise is.
TEST(EffectTrace, StaysWhereTheNoiseDoublesAndStandsHalfAsFarOut) {
  const std::vector<data::HiddenEffect> one_way = {{"direction_asymmetry", 0.05}};
  const Traced quiet = traced(one_way, {{"torque_noise", 0.004}, {"coloured_share", 0.0}});
  const Traced loud = traced(one_way, {{"torque_noise", 0.008}, {"coloured_share", 0.0}});
  EXPECT_NEAR(loud.traces[0].share / quiet.traces[0].share, 1.0, 0.05);
  EXPECT_NEAR(loud.traces[0].sigma / quiet.traces[0].sigma, 0.5, 0.03);
}

TEST(EffectTrace, IsOfEachEffectOfAPair) {
  const Traced pair = traced({{"direction_asymmetry", 0.05}, {"series_compliance", 0.05}});
  ASSERT_EQ(pair.traces.size(), 2U);
  for (const EffectTrace& trace : pair.traces) {
    if (trace.effect == "direction_asymmetry") {
      EXPECT_NEAR(trace.share, 0.025, 0.003);
    } else {
      EXPECT_LT(trace.share, 0.004);
    }
  }
}

ScoredCase with_traces(std::vector<double> shares) {
  ScoredCase one;
  for (const double share : shares) one.traces.push_back({"some", share, 10.0});
  return one;
}

TEST(CasesThatCanBeSeen, AreThoseWhoseEveryTraceIsLargeEnough) {
  const auto seen = that_can_be_seen({with_traces({}), with_traces({0.02}),
                                      with_traces({0.02, 0.001}), with_traces({kNotComputed})});
  ASSERT_EQ(seen.size(), 2U);
  EXPECT_EQ(seen[0].least_trace(), std::numeric_limits<double>::infinity());
  EXPECT_EQ(seen[1].least_trace(), 0.02);
}

}  // namespace
}  // namespace flexspline::studies
