// The torque of a joint that travels, recorded late and behind a filter of first order.
#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "active_cause.hpp"
#include "diagnosis/frame/frame.hpp"
#include "diagnosis/model/cause.hpp"
#include "diagnosis/search/exchange.hpp"
#include "diagnosis_checks.hpp"
#include "flexspline/core/simulate.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

constexpr double kInertia = 1.4;   // kg m2
constexpr double kNoise = 0.03;    // Nm
constexpr double kWarmUp = 150.0;  // s

/// How late a torque is recorded, s.
struct Chain {
  double delay = 0.0;
  double filter = 0.0;   ///< time constant behind the torque sensor
  double carried = 0.0;  ///< with which the inertia follows the joint
  double before = 0.0;   ///< Nm in the filter at the start, of what the joint did before
  double angle = 0.0;    ///< time constant behind the encoder
  double again = 0.0;    ///< of a second filter behind both
  double cold = 0.0;     ///< Nm of dry friction at the session's start, gone as it warms up
};

/// Back and forth at nearly constant speed: A asin(s sin wt)/asin(s).
struct Stroke {
  double speed;
  double position(double t) const {
    return kAmplitude * std::asin(kShare * std::sin(rate() * t)) / widest();
  }
  double velocity(double t) const {
    const double x = kShare * std::sin(rate() * t);
    return kAmplitude / widest() * kShare * rate() * std::cos(rate() * t) / std::sqrt(1.0 - x * x);
  }
  double acceleration(double t) const {
    constexpr double h = 1e-4;
    return (velocity(t + h) - velocity(t - h)) / (2.0 * h);
  }
  double duration() const { return 3.0 * 2.0 * std::numbers::pi / rate(); }

 private:
  static constexpr double kAmplitude = 0.55;
  static constexpr double kShare = 0.97;
  static double widest() { return std::asin(kShare); }
  double rate() const { return speed * widest() / (kAmplitude * kShare); }
};

/// Weight, dry and viscous friction.
double static_torque(const Stroke& s, double t, double dry = 0.8) {
  return -20.0 * std::sin(s.position(t)) + dry * std::tanh(s.velocity(t) / 0.01) +
         0.5 * s.velocity(t);
}

double dry_friction(const Chain& chain, double session) {
  return 0.8 + chain.cold * std::exp(-session / kWarmUp);
}

/// A filter of first order in steps that are short against it; 0: none.
class Filter {
 public:
  Filter(double time_constant, double step, double start)
      : kept_(time_constant > 0.0 ? std::exp(-step / time_constant) : 0.0), value_(start) {}
  double advance(double x) { return value_ = x + kept_ * (value_ - x); }

 private:
  double kept_, value_;
};

Recording recording_of(const Stroke& s, const Chain& chain, unsigned seed) {
  constexpr double interval = 0.01;
  constexpr int fine = 50;
  constexpr double step = interval / fine;
  Recording r;
  r.id = "speed-" + std::to_string(seed);
  r.start_s = 100.0 * seed;
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0.0, kNoise);
  std::normal_distribution<double> jitter(0.0, 2e-5);
  Filter carried(chain.carried, step, s.acceleration(-chain.delay));
  double recorded = static_torque(s, -chain.delay, dry_friction(chain, r.start_s)) +
                    kInertia * s.acceleration(-chain.delay);
  recorded += chain.before;
  Filter sensor(chain.filter, step, recorded);
  double seen = s.position(0.0);
  Filter encoder(chain.angle, step, seen);
  Filter sensor_again(chain.again, step, recorded);
  Filter encoder_again(chain.again, step, seen);
  for (double t = 0.0; t < s.duration(); t += interval) {
    r.time.push_back(t);
    r.channels[Quantity::angle].push_back(seen + jitter(random));
    r.channels[Quantity::torque].push_back(recorded + noise(random));
    for (int k = 0; k < fine; ++k) {
      const double then = t + (k + 0.5) * step - chain.delay;
      const double moved = kInertia * carried.advance(s.acceleration(then));
      const double dry = dry_friction(chain, r.start_s + then);
      recorded = sensor_again.advance(sensor.advance(static_torque(s, then, dry) + moved));
      seen = encoder_again.advance(encoder.advance(s.position(then + chain.delay)));
    }
  }
  return r;
}

RecordingSet joint(const Chain& chain) {
  RecordingSet set;
  set.name = "joint";
  set.rig = Rig::specimen;
  set.constants["gear_ratio"] = 100.0;
  unsigned seed = 1;
  for (double speed : {0.1, 0.3, 0.5, 0.7}) {
    set.recordings.push_back(recording_of({speed}, chain, seed++));
  }
  return set;
}

double parameter(const ModelSpec& model, std::string_view effect, std::string_view name) {
  for (const EffectSpec& one : model.effects) {
    if (one.effect != effect) continue;
    for (const auto& [key, value] : one.parameters) {
      if (key == name) return value;
    }
  }
  return std::nan("");
}

/// s, as a note says it; NaN where none does.
double common_filter_of(const Diagnosis& d) {
  const std::string before = "behind one filter of ";
  for (const std::string& note : d.notes) {
    const auto at = note.find(before);
    if (at != std::string::npos) return std::stod(note.substr(at + before.size()));
  }
  return std::nan("");
}

TEST(LateTorque, IsToldFromTheInertiaThatItHides) {
  const Diagnosis d = diagnosed(joint({.delay = 0.02, .filter = 0.06}));
  EXPECT_THAT(names(d), testing::UnorderedElementsAre("inertia_torque", "sensor_delay")) << d.says;
  EXPECT_NEAR(parameter(d.model->drive.torsion, "inertia_torque", "inertia"), kInertia,
              0.03 * kInertia);
  EXPECT_NEAR(parameter(d.model->drive.torsion, "torque_sensor_lag", "time_constant"), 0.06, 0.004);
  EXPECT_NEAR(parameter(d.model->drive.torsion, "sensor_delay", "delay"), 0.02, 0.004);
  EXPECT_LT(d.holdout.rmse_after, 1.5 * kNoise);
}

// A recording that begins while the filter still settles, 5 Nm off.
TEST(LateTorque, IsNotToldByWhatCameBeforeTheRecording) {
  const Diagnosis d = diagnosed(joint({.delay = 0.02, .filter = 0.06, .before = 5.0}));
  EXPECT_THAT(names(d), testing::UnorderedElementsAre("inertia_torque", "sensor_delay")) << d.says;
  EXPECT_LT(d.holdout.rmse_after, 1.5 * kNoise);
  for (const auto& series : d.series) EXPECT_GT(series.time.front(), 5 * 0.06) << "not shown";
}

// Behind the filter the torque of the friction is early at a reversal, and late after it.
TEST(LateTorque, IsNotThatOfAFilterOnBothChannels) {
  constexpr double kBoth = 0.03;
  const Diagnosis d = diagnosed(joint({.filter = kBoth, .angle = kBoth}));
  EXPECT_EQ(names(d), std::vector<std::string>{"inertia_torque"}) << d.says;
  EXPECT_NEAR(common_filter_of(d), kBoth, 0.2 * kBoth);
  EXPECT_NEAR(parameter(d.model->drive.torsion, "inertia_torque", "inertia"), kInertia,
              0.03 * kInertia);
  EXPECT_LT(d.holdout.rmse_after, 1.5 * kNoise);
}

// While the inertia is missing a delay explains more; beside it the filter does as well.
TEST(LateTorque, GivesWayToAFilterOnBothChannelsInTheEnd) {
  const auto frame = make_frame(joint({.filter = 0.03, .angle = 0.03}), 4000);
  ASSERT_TRUE(frame);
  Selection s;
  s.final = *fit_baseline(*frame);
  for (const char* id : {"sensor_delay", "inertia_torque"}) {
    const auto [row, form] = form_named(*frame, id);
    Accepted a;
    a.trial = try_cause(*frame, s.final, active(*frame, *row, *form));
    s.final.fit = a.trial.fit;
    s.accepted.push_back(std::move(a));
    ASSERT_TRUE(refresh(*frame, s.final, 8));
  }
  ASSERT_TRUE(exchange_for_better(*frame, {}, s));
  ASSERT_EQ(s.accepted.size(), 2U);
  EXPECT_EQ(s.accepted.front().trial.cause.row->id, "inertia_torque");
  EXPECT_EQ(s.accepted.back().trial.cause.row->id, "common_filter");
}

TEST(LateTorque, IsNotThatOfAFilterOfSecondOrderOnBothChannels) {
  const Diagnosis d = diagnosed(joint({.filter = 0.012, .angle = 0.012, .again = 0.012}));
  EXPECT_EQ(names(d), std::vector<std::string>{"inertia_torque"}) << d.says;
  EXPECT_LT(d.holdout.rmse_after, 1.5 * kNoise);
}

// What warms up goes by the friction before the filter, as the rest does.
TEST(LateTorque, IsNotThatOfAFilterOnBothChannelsOfAJointThatWarmsUp) {
  constexpr double kBoth = 0.03;
  const Diagnosis d = diagnosed(joint({.filter = kBoth, .angle = kBoth, .cold = 2.0}));
  EXPECT_THAT(names(d), testing::UnorderedElementsAre("inertia_torque", "thermal_friction_drift"))
      << d.says;
  EXPECT_NEAR(common_filter_of(d), kBoth, 0.2 * kBoth);
  const ModelSpec& model = d.model->drive.torsion;
  EXPECT_NEAR(parameter(model, "thermal_friction_drift", "time_constant"), kWarmUp, 0.1 * kWarmUp);
  EXPECT_LT(d.holdout.rmse_after, 1.5 * kNoise);
}

// The weight and the friction are on time then.
TEST(LateTorque, IsNotThatOfAnInertiaCarriedAlong) {
  const Diagnosis d = diagnosed(joint({.carried = 0.08}));
  ASSERT_EQ(names(d), std::vector<std::string>{"inertia_torque"}) << d.says;
  EXPECT_NEAR(parameter(d.model->drive.torsion, "carried_inertia", "time_constant"), 0.08, 0.004);
  EXPECT_NEAR(parameter(d.model->drive.torsion, "carried_inertia", "inertia"), kInertia,
              0.05 * kInertia);
  EXPECT_LT(d.holdout.rmse_after, 1.5 * kNoise);
}

// tau = sin wt through T tau' + tau = x is sin(wt - atan wT)/sqrt(1 + w2T2) when it has settled.
TEST(LateTorque, OfASineIsThatOfAFirstOrderFilter) {
  constexpr Index rows = 4000;
  Frame f;
  f.time = ArrayXd::LinSpaced(rows, 0.0, 0.002 * (rows - 1));
  f.segments = {{"one", 0, rows / 2}, {"two", rows / 2, rows / 2}};
  const double w = 12.0;
  const ArrayXd signal = (w * f.time).sin();
  EXPECT_TRUE((f.recorded(signal) == signal).all()) << "no filter";
  f.torque_lag = 0.05;
  const ArrayXd recorded = f.recorded(signal);
  const double wt = w * f.torque_lag;
  const ArrayXd settled = (w * f.time - std::atan(wt)).sin() / std::sqrt(1.0 + wt * wt);
  for (const Segment& s : f.segments) {
    EXPECT_EQ(recorded[s.first], signal[s.first]) << "starts settled";
    const auto late = Eigen::seqN(s.first + 600, s.count - 600);
    EXPECT_LT((recorded(late) - settled(late)).abs().maxCoeff(), w * w * 0.002 * 0.002 / 8.0);
  }
}

}  // namespace
}  // namespace flexspline::studies
