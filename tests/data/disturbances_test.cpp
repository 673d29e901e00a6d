#include <cmath>
#include <numeric>

#include <gmock/gmock.h>

#include "bench/hidden_measuring.hpp"
#include "hidden_fixture.hpp"

namespace flexspline::data {
namespace {

/// A small bench with one disturbance, and what it told of itself.
struct Disturbed {
  HiddenBench bench;
  std::vector<HiddenParameter> told;

  double at(std::string_view name) const {
    for (const HiddenParameter& one : told) {
      if (one.name == name) return one.value;
    }
    ADD_FAILURE() << "no parameter " << name;
    return 0.0;
  }
};

Disturbed disturbed(std::string_view id, BenchKind kind, std::uint64_t seed = 11) {
  Disturbed made{kind.travels ? draw_hidden_bench(kind, 3) : small_bench(kind.rig), {}};
  if (kind.travels) made.bench.nuisances = {};
  made.told = (*find_disturbance(id))->apply(made.bench, seed);
  return made;
}

HiddenDataset run(const HiddenBench& bench) { return run_hidden_bench(bench, {}).value(); }

/// What the instruments added to the transmitted torque of a long recording at rest.
std::vector<double> noise_of(HiddenBench bench) {
  bench.nuisances.torque_noise = 0.004;
  bench.design = {{HiddenMotion::sine, bench.gear.rated_torsion, 1.0, 3.0, 60000}};
  const HiddenDataset data = run(bench);
  std::vector<double> noise = data.measured.recordings[0].channels.at(Quantity::transmitted_torque);
  const auto& ideal = data.ideal.recordings[0].channels.at(Quantity::transmitted_torque);
  for (std::size_t k = 0; k < noise.size(); ++k) {
    noise[k] = (noise[k] - ideal[k]) / data.answer.noise_std;
  }
  return noise;
}

double correlation(const std::vector<double>& x, std::size_t lag) {
  return std::inner_product(x.begin() + static_cast<std::ptrdiff_t>(lag), x.end(), x.begin(), 0.0) /
         std::inner_product(x.begin(), x.end(), x.begin(), 0.0);
}

// A share c of first-order noise correlated over s samples: c exp(-k/s) at lag k, variance 1.
TEST(ColouredNoise, HasTheCorrelationOfAFirstOrderProcess) {
  const Disturbed made = disturbed("coloured_noise", Rig::specimen);
  const double samples = made.at("samples");
  EXPECT_THAT(samples, testing::AnyOf(4.0, 10.0, 20.0, 60.0));
  const std::vector<double> noise = noise_of(made.bench);
  EXPECT_NEAR(std::inner_product(noise.begin(), noise.end(), noise.begin(), 0.0) /
                  static_cast<double>(noise.size()),
              1.0, 0.1);
  for (const std::size_t lag : {1U, 5U, 10U, 20U}) {
    const double wanted = made.at("share") * std::exp(-static_cast<double>(lag) / samples);
    EXPECT_NEAR(correlation(noise, lag), wanted, 0.06) << lag;
  }
}

// Of Student's t with n degrees the share beyond 4 rms is 15 to 90 times the normal's 6.3e-5.
TEST(HeavyTails, HaveTheirRmsAndOutliersThatANormalHasNot) {
  const Disturbed made = disturbed("heavy_tails", Rig::specimen);
  EXPECT_THAT(made.at("degrees"), testing::AllOf(testing::Ge(3.0), testing::Le(5.0)));
  const std::vector<double> noise = noise_of(made.bench);
  double square = 0.0;
  double beyond = 0.0;
  for (const double value : noise) {
    square += value * value;
    beyond += std::abs(value) > 4.0 ? 1.0 : 0.0;
  }
  const auto count = static_cast<double>(noise.size());
  EXPECT_NEAR(square / count, 1.0, 0.15);
  EXPECT_GT(beyond / count, 15.0 * 6.3e-5);
  EXPECT_LT(std::abs(correlation(noise, 1)), 0.02) << "white";
}

TEST(AsymmetricSpring, IsStifferOnOneSideByWhatItTells) {
  for (const Rig rig : {Rig::locked, Rig::free, Rig::specimen}) {
    const HiddenGear plain = small_bench(rig).gear;
    const Disturbed made = disturbed("asymmetric_spring", rig);
    const double far = 3.0 * plain.rated_torsion * made.at("side");
    EXPECT_GE(made.at("excess"), 0.0);
    EXPECT_LE(made.at("excess"), 0.1);
    EXPECT_NEAR(made.bench.gear.stiffness(far) / plain.stiffness(far), 1.0 + made.at("excess"),
                1e-3 * made.at("excess"));
    EXPECT_NEAR(made.bench.gear.stiffness(-far) / plain.stiffness(-far), 1.0,
                1e-3 * made.at("excess"));
  }
}

TEST(EncoderZero, MovesTheTorsionByWhatItTells) {
  const Disturbed made = disturbed("encoder_zero", Rig::locked);
  EXPECT_LE(std::abs(made.at("zero")), 0.5 * made.bench.gear.rated_torsion);
  const HiddenDataset data = run(made.bench);
  const double shift = data.measured.recordings[0].channels.at(Quantity::motor_angle)[0] -
                       data.ideal.recordings[0].channels.at(Quantity::motor_angle)[0];
  EXPECT_NEAR(shift / made.bench.gear.gear_ratio, made.at("zero"), 1e-12);
  const Disturbed arm = disturbed("encoder_zero", Rig::servo);
  const HiddenDataset swung = run(arm.bench);
  EXPECT_NEAR(swung.measured.recordings[0].channels.at(Quantity::load_angle)[0],
              swung.ideal.recordings[0].channels.at(Quantity::load_angle)[0] + arm.at("zero"),
              1e-12);
}

// Step, ramp: 1 - exp(-t/T), t - T (1 - exp(-t/T)), both of all channels alike.
TEST(CommonFilter, AnswersAStepAndARampAsAFirstOrderLowPass) {
  HiddenSignals ramp;
  ramp.step = 1.0 / 8.0;  // of a sampling interval of 1 s
  for (int k = 0; k < 200; ++k) {
    for (auto* channel : {&ramp.motor_angle, &ramp.load_angle, &ramp.torque, &ramp.motor_torque}) {
      channel->push_back(0.125 * k);
    }
  }
  constexpr double kTime = 2.3;
  const HiddenSignals out = filtered(ramp, kTime);
  for (const std::size_t k : {1U, 8U, 40U, 199U}) {
    const double t = 0.125 * static_cast<double>(k);
    EXPECT_NEAR(out.torque[k], t + kTime * std::expm1(-t / kTime), 1e-12 * t);
    EXPECT_DOUBLE_EQ(out.motor_angle[k], out.torque[k]);
    EXPECT_DOUBLE_EQ(out.load_angle[k], out.motor_torque[k]);
  }
  EXPECT_EQ(filtered(ramp, 0.0).torque, ramp.torque);
}

TEST(CoarseEncoders, ReadMultiplesOfTheirStep) {
  for (const BenchKind kind : bench_kinds()) {
    const Disturbed made = disturbed("coarse_encoders", kind);
    const Quantity motion = kind.rig == Rig::servo      ? Quantity::load_angle
                            : kind.travels              ? Quantity::angle
                            : kind.rig == Rig::specimen ? Quantity::torsion
                                                        : Quantity::motor_angle;
    const double step = made.at(kind.rig == Rig::specimen ? "step"
                                : kind.rig == Rig::servo  ? "load_step"
                                                          : "motor_step");
    const Recording recording = run(made.bench).measured.recordings[0];
    for (const double value : recording.channels.at(motion)) {
      EXPECT_NEAR(value / step, std::round(value / step), 1e-6) << name_of(kind);
    }
  }
}

// The answer hangs on the seed alone, and what is disturbed runs on every bench that has it.
TEST(Disturbances, ArePureFunctionsOfTheSeed) {
  for (const DisturbanceRow& row : disturbances()) {
    EXPECT_FALSE(row.says.empty()) << row.id;
    for (const BenchKind kind : row.kinds) {
      const HiddenDataset one = run(disturbed(row.id, kind).bench);
      EXPECT_TRUE(same_bits(one.measured, run(disturbed(row.id, kind).bench).measured));
      EXPECT_FALSE(disturbed(row.id, kind).told.empty());
    }
  }
}

TEST(Disturbances, AreRefusedByAnUnknownName) {
  const auto none = find_disturbance("colored_noise");
  ASSERT_FALSE(none);
  EXPECT_THAT(none.error().message(), testing::HasSubstr("coloured_noise"));
}

TEST(Joint, BalancesWeightAndFrictionOverItsAngle) {
  HiddenBench bench = draw_hidden_bench({Rig::specimen, true}, 8);
  bench.nuisances = {};
  const HiddenDataset data = run(bench);
  EXPECT_DOUBLE_EQ(data.measured.constants.at("gear_ratio"), 50.0);
  for (const Recording& r : data.ideal.recordings) {
    const Differences angle = series(r, Quantity::angle);
    const std::vector<double>& torque = r.channels.at(Quantity::transmitted_torque);
    double most = 0.0;
    for (std::size_t k = 2; k + 2 < torque.size(); ++k) {
      const double left =
          torque[k] - bench.gear.stiffness(angle.value[k]) - bench.gear.damping(angle.first(k));
      most = std::max(most, std::abs(left));
    }
    EXPECT_LT(most, 0.02 * data.answer.peak_torque) << r.id;
  }
  const double travel = bench.gear.rated_torsion;
  EXPECT_GT(std::abs(bench.gear.stiffness(travel) + bench.gear.stiffness(-travel)), 0.0);
}

TEST(Incidents, ActInTheirPlaceAndNowhereElse) {
  for (const HiddenRow& row : hidden_effects()) {
    if (hidden_class(row.id) != HiddenClass::incident) continue;
    for (const Rig rig : row.rigs) {
      const HiddenBench bench = small_bench(rig);
      const HiddenDataset with = run_hidden_bench(bench, {{std::string(row.id), 0.06}}).value();
      const HiddenDataset without = run(bench);
      const HiddenPlace place = with.answer.effects[0].place.value();
      const Quantity effort =
          rig == Rig::servo ? Quantity::motor_torque : Quantity::transmitted_torque;
      double inside = 0.0;
      for (std::size_t i = 0; i < with.ideal.recordings.size(); ++i) {
        const Recording& r = with.ideal.recordings[i];
        for (std::size_t k = 0; k < r.time.size(); ++k) {
          const double by =
              r.channels.at(effort)[k] - without.ideal.recordings[i].channels.at(effort)[k];
          const bool there = r.id == place.recording &&
                             r.time[k] > place.from_s - 1e-3 * place.duration_s &&
                             r.time[k] < place.to_s + 1e-3 * place.duration_s;
          if (there) inside = std::max(inside, std::abs(by));
          if (there) continue;
          EXPECT_LT(std::abs(by), 0.01 * with.answer.peak_torque) << row.id;
        }
      }
      EXPECT_GT(inside, 0.0) << row.id << " on " << name_of(rig);
    }
  }
}

}  // namespace
}  // namespace flexspline::data
