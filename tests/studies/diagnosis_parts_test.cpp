#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "autoregression.hpp"
#include "diagnosis/frame/periodic_angle.hpp"
#include "diagnosis/frame/running.hpp"
#include "diagnosis/model/noise.hpp"
#include "diagnosis/search/locate.hpp"
#include "diagnosis/search/selection.hpp"
#include "drive_frame.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

TEST(RunningParabola, WeightsSumToOneAndAreSymmetric) {
  for (const Index half : {2, 5, 25, 80}) {
    const ArrayXd w = parabola_weights(half);
    ASSERT_EQ(w.size(), 2 * half + 1);
    EXPECT_NEAR(w.sum(), 1.0, 1e-13);
    EXPECT_LT((w - w.reverse()).abs().maxCoeff(), 1e-16);
  }
  const ArrayXd five = parabola_weights(2);  // Savitzky and Golay (1964): -3, 12, 17, 12, -3 by 35
  EXPECT_NEAR(five[0] * 35.0, -3.0, 1e-13);
  EXPECT_NEAR(five[1] * 35.0, 12.0, 1e-13);
  EXPECT_NEAR(five[2] * 35.0, 17.0, 1e-13);
}

// A projection: the squares of its weights sum to the middle one.
TEST(RunningParabola, TakesItsMiddleWeightOfWhiteNoise) {
  const ArrayXd w = parabola_weights(25);
  EXPECT_NEAR(w.square().sum(), w[25], 1e-14);
  const ArrayXd left = about_parabola(coloured_noise(200000, 0.0, 1), w);
  EXPECT_NEAR(left.square().mean(), 1.0 - w[25], 0.015);
}

TEST(RunningParabola, LeavesNothingOfACubicAndMostOfAStep) {
  const ArrayXd w = parabola_weights(25);
  const ArrayXd x = ArrayXd::LinSpaced(300, -1.0, 2.0);
  const ArrayXd cubic = 3.0 - 2.0 * x + 5.0 * x.square() - 4.0 * x.cube();
  EXPECT_EQ(about_parabola(cubic, w).size(), 250);
  EXPECT_LT(about_parabola(cubic, w).abs().maxCoeff(), 1e-12);
  const ArrayXd step = (x > 0.5).cast<double>();
  EXPECT_GT(about_parabola(step, w).abs().maxCoeff(), 0.4);
  EXPECT_EQ(about_parabola(cubic.head(50), w).size(), 0) << "shorter than the window";
}

/// Findings whose residual in one equation is given, of noise of unit level; the others are noise.
Findings findings_of(const Frame& frame, Equation equation, const ArrayXd& residual) {
  Findings findings;
  unsigned seed = 10;
  for (const Equation each : frame.equations) {
    const std::size_t e = index_of(each);
    findings.fit.residual[e] = coloured_noise(frame.rows(), 0.0, ++seed);
    if (each == equation) findings.fit.residual[e] += residual;
    findings.fit.prediction[e] = frame.torque;
    findings.weight[e] = frame.usable;
  }
  return findings;
}

struct Located {
  std::string coordinate;
  Equation equation;
  ArrayXd (*signal)(const Frame&);  ///< of order one
};

ArrayXd unit(const ArrayXd& x) { return x / x.abs().maxCoeff(); }

// The way since the last reversal of the torsion, with the sign of the motion.
ArrayXd since_reversal(const Frame& f) {
  ArrayXd way = ArrayXd::Zero(f.rows());
  for (const Segment& s : f.segments) {
    double turned_at = f.torsion[s.first];
    for (Index r = s.first + 1; r < s.first + s.count; ++r) {
      if (f.torsion_rate[r] * f.torsion_rate[r - 1] <= 0.0) turned_at = f.torsion[r];
      way[r] = std::abs(f.torsion[r] - turned_at);
    }
  }
  return (1.0 - 4.0 * unit(way)).max(0.0) * f.torsion_rate.sign();
}

const std::vector<Located>& located_signals() {
  using enum Equation;
  static const std::vector<Located> list = {
      {"torsion", torsion, [](const Frame& f) { return ArrayXd((7.0 * unit(f.torsion)).cos()); }},
      {"velocity", motor,
       [](const Frame& f) { return ArrayXd((9.0 * unit(f.motor_speed)).sin()); }},
      {"acceleration", load, [](const Frame& f) { return unit(f.load_acceleration); }},
      {"load", motor,
       [](const Frame& f) { return ArrayXd(unit(f.torque.abs()) * f.motor_speed.sign()); }},
      {"lag", torsion, [](const Frame& f) { return unit(f.torque_rate); }},
      {"reversal_memory", torsion, since_reversal},
      {"time", load, [](const Frame& f) { return unit(f.clock); }},
      {"time", motor,
       [](const Frame& f) {
         ArrayXd course = ArrayXd::Zero(f.rows());
         for (const Segment& s : f.segments) {
           course.segment(s.first, s.count) = ArrayXd::LinSpaced(s.count, -1.0, 1.0);
         }
         return ArrayXd(course * f.motor_speed.sign());
       }},
      {"constant", motor, [](const Frame& f) { return ArrayXd(ArrayXd::Ones(f.rows())); }},
      {"load_angle", load,
       [](const Frame& f) { return ArrayXd((-(10.0 * f.load_angle).square()).exp()); }},
      {"motor_angle", torsion,
       [](const Frame& f) { return ArrayXd((2.0 * f.motor_angle + 0.4).sin()); }},
      {"motor_angle", motor,
       [](const Frame& f) { return ArrayXd((6.0 * f.motor_angle).cos() * f.motor_speed.sign()); }},
  };
  return list;
}

TEST(Locate, AResidualThatFollowsOneCoordinateIsFoundThere) {
  const Frame frame = closed_form_frame();
  for (const Located& each : located_signals()) {
    const auto scores = locate(frame, findings_of(frame, each.equation, 2.0 * each.signal(frame)));
    ASSERT_FALSE(scores.empty());
    EXPECT_EQ(scores.front().coordinate, each.coordinate);
    EXPECT_EQ(scores.front().equation, each.equation) << each.coordinate;
    EXPECT_GT(scores.front().statistic, Limits{}.gain) << each.coordinate;
    EXPECT_TRUE(
        std::ranges::is_sorted(scores, std::ranges::greater{}, &CoordinateScore::statistic));
  }
}

TEST(Locate, AProductOfPositionAndSpeedIsFoundThoughNeitherOrdersIt) {
  const Frame frame = closed_form_frame();
  const ArrayXd product = 2.0 * unit(frame.torsion) * unit(frame.torsion_rate);
  const auto scores = locate_anything(frame, findings_of(frame, Equation::torsion, product));
  EXPECT_EQ(scores.front().coordinate, "velocity");
  EXPECT_NE(scores.front().says.find("at every position"), std::string::npos);
  EXPECT_GT(scores.front().statistic, Limits{}.gain);
  for (const CoordinateScore& score : scores) {
    const bool one_of_both =
        score.says.ends_with("the torsion") || score.says.ends_with("the speed");
    if (one_of_both) {
      EXPECT_LT(score.statistic, 0.25 * scores.front().statistic) << score.says;
    }
  }
}

// A spring that softens from recording to recording: f(phi) times a number of each.
TEST(Locate, AGainOfEachRecordingIsFoundThoughNoCoordinateOrdersIt) {
  const Frame frame = closed_form_frame();
  ASSERT_GE(frame.segments.size(), 2U);
  auto findings = findings_of(frame, Equation::torsion, ArrayXd::Zero(frame.rows()));
  const ArrayXd spring = unit(frame.torsion);
  findings.fit.prediction[index_of(Equation::torsion)] = 10.0 * spring;
  ArrayXd gain = ArrayXd::Ones(frame.rows());
  for (std::size_t i = 0; i < frame.segments.size(); i += 2) {
    gain.segment(frame.segments[i].first, frame.segments[i].count).setConstant(-1.0);
  }
  findings.fit.residual[index_of(Equation::torsion)] += 2.0 * gain * spring;
  const auto scores = locate_anything(frame, findings);
  EXPECT_EQ(scores.front().coordinate, "time");
  EXPECT_NE(scores.front().says.find("in every recording"), std::string::npos);
  EXPECT_GT(scores.front().statistic, Limits{}.gain);
  EXPECT_LT(locate(frame, findings).front().statistic, 0.5 * scores.front().statistic);
}

TEST(Locate, NoiseIsNowhere) {
  const Frame frame = closed_form_frame();
  for (const CoordinateScore& score :
       locate_anything(frame, findings_of(frame, Equation::motor, ArrayXd::Zero(frame.rows())))) {
    EXPECT_LT(score.statistic, 0.25 * Limits{}.gain) << score.coordinate;
  }
}

TEST(Locate, ColouredNoiseCountsForLess) {
  const Frame frame = closed_form_frame();
  auto findings = findings_of(frame, Equation::load, 0.3 * unit(frame.load_acceleration));
  const double white = locate(frame, findings).front().statistic;
  for (EquationNoise& noise : findings.noise) noise.colour = 4.0;
  const double coloured = locate(frame, findings).front().statistic;
  EXPECT_LT(coloured, 0.3 * white);
}

// Of a signal that its columns hold: the largest of it over the largest torque of the equation.
TEST(Locate, SaysHowMuchTorqueIsOrdered) {
  const Frame frame = closed_form_frame();
  for (const double level : {2.0, 4.0}) {
    const auto scores =
        locate(frame, findings_of(frame, Equation::motor, ArrayXd::Constant(frame.rows(), level)));
    const auto of_motor = std::ranges::find_if(scores, [](const CoordinateScore& score) {
      return score.equation == Equation::motor && score.coordinate == "constant";
    });
    ASSERT_NE(of_motor, scores.end());
    EXPECT_NEAR(of_motor->size * frame.motor_torque.abs().maxCoeff(), level, 0.03 * level);
  }
}

TEST(Locate, TheWorstWindowIsWhereTheResidualIsLargest) {
  const Frame frame = closed_form_frame();
  ArrayXd burst = ArrayXd::Zero(frame.rows());
  burst.segment(4500, 150).setConstant(9.0);
  const auto worst =
      worst_window(frame, findings_of(frame, Equation::torsion, burst), Equation::torsion);
  EXPECT_EQ(worst.segment, 1U);
  EXPECT_LE(worst.from_s, frame.time[4650]);
  EXPECT_GE(worst.to_s, frame.time[4500]);
  EXPECT_LT(worst.to_s - worst.from_s, 0.1 * frame.duration);
}

/// A free drive whose motor follows theta_m = s + P(theta_m), s = N (theta_l + phi): what it is
/// asked for, and what it does.
struct Wobbling {
  RecordingSet set;
  ArrayXd speed, acceleration;
};

Wobbling wobbling(const PeriodicAngle& error, double noise) {
  const Frame f = closed_form_frame();
  Wobbling w;
  w.set.rig = Rig::free;
  w.set.constants["gear_ratio"] = f.ratio;
  w.speed.resize(f.rows()), w.acceleration.resize(f.rows());
  const ArrayXd jitter = noise * coloured_noise(f.rows(), 0.0, 7);
  for (const Segment& s : f.segments) {
    Recording recording;
    recording.id = s.id;
    for (Index r = s.first; r < s.first + s.count; ++r) {
      double theta = f.motor_angle[r];
      for (int k = 0; k < 50; ++k) theta = f.motor_angle[r] + error.value(theta);
      const double stretch = 1.0 / (1.0 - error.slope(theta));
      w.speed[r] = f.motor_speed[r] * stretch;
      w.acceleration[r] =
          (f.motor_acceleration[r] + error.curvature(theta) * w.speed[r] * w.speed[r]) * stretch;
      recording.time.push_back(f.time[r]);
      recording.channels[Quantity::motor_angle].push_back(theta);
      recording.channels[Quantity::load_angle].push_back(f.load_angle[r] + jitter[r]);
      recording.channels[Quantity::transmitted_torque].push_back(f.torque[r]);
    }
    w.set.recordings.push_back(std::move(recording));
  }
  return w;
}

// Small beside a turn, so that P(theta) is also P of the turn without it, to first order.
const PeriodicAngle kError{{{2.0, 2.4e-3, -1.0e-3}, {4.0, -0.7e-3, 0.5e-3}}};

TEST(PeriodicAngle, SlopeAndCurvatureAreItsDerivatives) {
  const double h = 1e-4;
  for (const double theta : {0.0, 0.7, 2.9, 11.0}) {
    const double ahead = kError.value(theta + h);
    const double behind = kError.value(theta - h);
    EXPECT_NEAR(kError.slope(theta), (ahead - behind) / (2.0 * h), 1e-9);
    EXPECT_NEAR(kError.curvature(theta), (ahead - 2.0 * kError.value(theta) + behind) / (h * h),
                1e-6);
  }
}

TEST(PeriodicAngle, FindsTheOrdersAndAmplitudesThatAreThere) {
  const auto found = periodic_angle(wobbling(kError, 1e-6).set);
  const auto amplitude = [&](double order) {
    double sum = 0.0;
    for (const auto& t : found.terms) sum += t.order == order ? std::hypot(t.sine, t.cosine) : 0.0;
    return sum;
  };
  EXPECT_NEAR(amplitude(2.0), std::hypot(2.4e-3, 1.0e-3), 1e-4);
  EXPECT_NEAR(amplitude(4.0), std::hypot(0.7e-3, 0.5e-3), 1e-4);
  EXPECT_LT(amplitude(1.0), 1e-4);
  for (const auto& t : found.terms) {
    if (t.order != 2.0) continue;
    EXPECT_NEAR(t.sine, 2.4e-3, 1e-4);
    EXPECT_NEAR(t.cosine, -1.0e-3, 1e-4);
  }
}

TEST(PeriodicAngle, FindsNothingInNoiseNorOnOtherRigs) {
  EXPECT_TRUE(periodic_angle(wobbling({}, 1e-5).set).terms.empty());
  auto locked = wobbling(kError, 1e-6).set;
  locked.rig = Rig::locked;
  EXPECT_TRUE(periodic_angle(locked).terms.empty());
}

// Jumps look like turns wherever they happen to fall; the other recordings know better.
TEST(PeriodicAngle, IsNotMisledByARecordingWhoseTorsionJumps) {
  auto set = wobbling({}, 1e-6).set;
  Recording stairs = set.recordings.front();
  stairs.id = "stairs";
  auto& load = stairs.channels[Quantity::load_angle];
  for (std::size_t i = 0; i < load.size(); ++i) load[i] += (i / 150) % 2 == 0 ? 3e-4 : -3e-4;
  set.recordings.push_back(stairs);
  for (const auto& t : periodic_angle(set).terms) {
    EXPECT_LT(std::hypot(t.sine, t.cosine), 2e-5) << t.order;
  }
}

// An amplitude's standard error in n samples of noise s is s sqrt(2/n), at the motor N times that.
TEST(PeriodicAngle, IsTenStandardErrorsOrMore) {
  const double noise = 1e-5;
  const Frame f = closed_form_frame();
  const double error = f.ratio * noise * std::sqrt(2.0 / static_cast<double>(f.rows()));
  const auto found = [&](double errors) {
    return periodic_angle(wobbling({{{2.0, errors * error, 0.0}}}, noise).set).terms.size();
  };
  EXPECT_EQ(found(6.0), 0u);
  EXPECT_EQ(found(30.0), 1u);
}

TEST(PeriodicAngle, IsNotWhatOneRecordingHasOfItsOwn) {
  auto set = wobbling({}, 1e-6).set;
  Recording other = wobbling(kError, 1e-6).set.recordings.front();
  RecordingSet alone = set;
  alone.recordings = {other};
  ASSERT_FALSE(periodic_angle(alone).terms.empty());
  other.id = "other";
  set.recordings.push_back(other);
  EXPECT_TRUE(periodic_angle(set).terms.empty());
}

// Two encoders of different noise: each smoothed in its own way, their difference has what the ways
// differ by, far more than what is left of the noise where the difference is smoothed.
TEST(SmoothTorsion, IsAsGoodAsItsOwnNoiseAllows) {
  const Frame f = closed_form_frame();
  const auto set = wobbling({}, 2e-5).set;
  const auto channels = channels_with(set, set.recordings.front(), {});
  ASSERT_TRUE(channels);
  double together = 0.0, apart = 0.0;
  const std::size_t count = set.recordings.front().time.size();
  for (std::size_t i = 50; i + 50 < count; ++i) {
    const double truth = f.torsion_rate[static_cast<Index>(i)];
    const double difference = channels->motor_speed[i] / f.ratio - channels->load_speed[i];
    together += std::pow(channels->torsion_rate[i] - truth, 2);
    apart += std::pow(difference - truth, 2);
  }
  EXPECT_LT(together, 0.5 * apart);
}

// phi = s/N - theta_l of the drive that does not wobble.
TEST(PeriodicAngle, IsInTheFramesRateWhatTheLawsDoNotSee) {
  const auto frame = make_frame(wobbling(kError, 1e-7).set, 1'000'000);
  ASSERT_TRUE(frame) << frame.error().message();
  ASSERT_EQ(frame->periodic_rate.size(), frame->rows());
  const Frame f = closed_form_frame();
  const ArrayXd plain = frame->torsion_rate - frame->periodic_rate;
  const auto off = [&](const ArrayXd& rate) {
    double most = 0.0;
    for (const Segment& s : frame->segments) {
      const auto true_one = std::ranges::find(f.segments, s.id, &Segment::id);
      const ArrayXd wrong =
          rate.segment(s.first, s.count) - f.torsion_rate.segment(true_one->first, s.count);
      most = std::max(most, wrong.segment(50, s.count - 100).abs().maxCoeff());
    }
    return most / f.rate_range;
  };
  EXPECT_LT(off(plain), 0.02);
  EXPECT_GT(off(frame->torsion_rate), 0.2);
  const auto steady = make_frame(wobbling({}, 1e-7).set, 1'000'000);
  ASSERT_TRUE(steady);
  EXPECT_EQ(steady->periodic_rate.size(), 0);
}

TEST(PeriodicAngle, KeepsItOutOfTheSmoothingAndPutsItBack) {
  const Wobbling w = wobbling(kError, 1e-7);
  const auto found = periodic_angle(w.set);
  ASSERT_FALSE(found.terms.empty());
  const auto kept = channels_with(w.set, w.set.recordings.front(), found);
  ASSERT_TRUE(kept.has_value());
  double speed = 0.0;
  double acceleration = 0.0;
  const std::size_t count = w.set.recordings.front().time.size();
  for (std::size_t i = 50; i + 50 < count; ++i) {
    const Index r = static_cast<Index>(i);
    speed = std::max(speed, std::abs(kept->motor_speed[i] - w.speed[r]));
    acceleration =
        std::max(acceleration, std::abs(kept->motor_acceleration[i] - w.acceleration[r]));
  }
  EXPECT_LT(speed, 0.01 * w.speed.abs().maxCoeff());
  EXPECT_LT(acceleration, 0.05 * w.acceleration.abs().maxCoeff());
  const double ratio = w.set.constants.at("gear_ratio");
  double torsion = 0.0;
  for (std::size_t i = 50; i + 50 < count; ++i) {
    const double difference = kept->motor_speed[i] / ratio - kept->load_speed[i];
    torsion = std::max(torsion, std::abs(kept->torsion_rate[i] - difference));
  }
  EXPECT_LT(torsion, 0.01 * w.speed.abs().maxCoeff() / ratio);
}

}  // namespace
}  // namespace flexspline::studies
