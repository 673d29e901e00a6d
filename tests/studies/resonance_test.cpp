// A resonance that a model lacks, against a mode that is integrated by another method.
#include "diagnosis/unnamed/resonance.hpp"

#include <cmath>
#include <numbers>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "diagnosis/frame/folds.hpp"
#include "drive_frame.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

constexpr double kFrequency = 40.0, kDamping = 0.04;  // rad/s, 1
constexpr double kNoise = 0.2;                        // Nm

// Runge and Kutta's classical method in steps of a tenth of a row's.
ArrayXd place_of(const Frame& frame, const ArrayXd& u, double w, double z) {
  ArrayXd place = ArrayXd::Zero(u.size());
  constexpr int kSteps = 10;
  for (const Segment& s : frame.segments) {
    double q = u[s.first], v = 0.0;
    place[s.first] = q;
    for (Index r = s.first; r + 1 < s.first + s.count; ++r) {
      const double h = frame.interval / kSteps;
      for (int i = 0; i < kSteps; ++i) {
        const auto at = [&](double part) {
          const double along = (i + part) / kSteps;
          return (1.0 - along) * u[r] + along * u[r + 1];
        };
        const auto rate = [&](double place_now, double speed, double part) {
          return w * w * (at(part) - place_now) - 2.0 * z * w * speed;
        };
        const double k1 = rate(q, v, 0.0), p1 = v;
        const double k2 = rate(q + 0.5 * h * p1, v + 0.5 * h * k1, 0.5), p2 = v + 0.5 * h * k1;
        const double k3 = rate(q + 0.5 * h * p2, v + 0.5 * h * k2, 0.5), p3 = v + 0.5 * h * k2;
        const double k4 = rate(q + h * p3, v + h * k3, 1.0), p4 = v + h * k3;
        q += h / 6.0 * (p1 + 2.0 * p2 + 2.0 * p3 + p4);
        v += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
      }
      place[r + 1] = q;
    }
  }
  return place;
}

ArrayXd drawn(Index rows) {
  std::mt19937_64 engine(7);
  std::normal_distribution<double> normal(0.0, kNoise);
  return ArrayXd::NullaryExpr(rows, [&] { return normal(engine); });
}

class OneResonance : public testing::Test {
 protected:
  OneResonance() {
    const std::size_t e = index_of(Equation::torsion);
    frame_.equations = {Equation::torsion};
    torque_ = frame_.torque + 20.0 * frame_.motor_speed.sign();
    frame_.torque_range = torque_.abs().maxCoeff();
    final_.fit.prediction[e] = torque_;
    final_.weight[e] = ArrayXd::Constant(frame_.rows(), 1.0 / kNoise);
    final_.noise[e].level = {kNoise, kNoise};
    final_.noise[e].colour = 1.0;
  }

  std::optional<Resonance> found(const ArrayXd& residual) {
    final_.fit.residual[index_of(Equation::torsion)] = residual;
    Proof proof;
    proof.by_fold.assign(folds_of(frame_).size(), final_.fit);
    return find_resonance(frame_, final_, proof, Limits{});
  }

  Frame frame_ = closed_form_frame();
  ArrayXd torque_;
  Findings final_;
};

// To two of the last steps of its search, 0.2 % of a frequency and 6 % of a damping ratio; the peak
// of a mode that rings goes with the latter. One damping ratio lies between two that are tried
// first.
TEST_F(OneResonance, IsFoundWithItsFrequencyAndDamping) {
  for (double damping : {0.01, kDamping, 0.08, 0.3}) {
    const ArrayXd ring = 0.1 * (place_of(frame_, torque_, kFrequency, damping) - torque_);
    const auto one = found(ring + 0.01 * drawn(frame_.rows()));
    ASSERT_TRUE(one) << damping;
    EXPECT_EQ(one->equation, Equation::torsion);
    EXPECT_NEAR(one->frequency, kFrequency, 0.004 * kFrequency) << damping;
    EXPECT_NEAR(one->damping, damping, 0.12 * damping);
    EXPECT_NEAR(one->size, ring.abs().maxCoeff() / frame_.torque_range, 0.12 * one->size);
  }
}

TEST_F(OneResonance, LeavesNoiseOnRowsHeldOut) {
  const ArrayXd ring = 0.1 * (place_of(frame_, torque_, kFrequency, kDamping) - torque_);
  const auto one = found(ring + drawn(frame_.rows()));
  ASSERT_TRUE(one);
  const double deviation = 1.0 / std::sqrt(2.0 * held_out(frame_).sum());  // of an rms
  EXPECT_NEAR(one->proof.rmse_after, kNoise, 3.0 * deviation * kNoise);
  EXPECT_THAT(in_words(*one), testing::HasSubstr("resonance at"));
}

// Coloured noise of the measured torque is an input of the motor equation, and taken back by what
// is left there, as if that answered it.
TEST_F(OneResonance, IsNotNoiseOfTheMeasuredTorque) {
  ArrayXd noise = drawn(frame_.rows());
  for (Index r = 1; r < frame_.rows(); ++r) noise[r] += 0.8 * noise[r - 1];
  noise *= frame_.torque_range / (10.0 * noise.abs().maxCoeff());
  const std::size_t motor = index_of(Equation::motor);
  frame_.equations = {Equation::torsion, Equation::motor};
  frame_.motor_torque = torque_ / frame_.ratio;
  final_.fit.prediction[motor] = (torque_ + noise) / frame_.ratio;
  final_.fit.residual[motor] = (0.1 * drawn(frame_.rows()) - noise) / frame_.ratio;
  final_.weight[motor] = frame_.ratio * final_.weight[index_of(Equation::torsion)];
  final_.noise[motor].level = {kNoise / frame_.ratio, kNoise / frame_.ratio};
  final_.noise[motor].colour = 1.0;
  EXPECT_FALSE(found(noise));
}

TEST_F(OneResonance, IsNotInNoise) { EXPECT_FALSE(found(drawn(frame_.rows()))); }

// Of a mode that answers nothing but one recording nothing is left on another.
TEST_F(OneResonance, IsNotWhatHeldOutRowsDoNotHave) {
  ArrayXd ring = 0.1 * (place_of(frame_, torque_, kFrequency, kDamping) - torque_);
  ring *= 1.0 - held_out(frame_);
  EXPECT_FALSE(found(ring + drawn(frame_.rows())));
}

TEST_F(OneResonance, IsNotLookedForAmongTrifles) {
  const ArrayXd ring = place_of(frame_, torque_, kFrequency, kDamping) - torque_;
  const double rms = std::sqrt(ring.square().mean());
  const double trifle = Limits{}.trifle() * frame_.torque_range;
  EXPECT_FALSE(found(0.5 * trifle / rms * ring + 0.01 * drawn(frame_.rows())));
  EXPECT_TRUE(found(2.0 * trifle / rms * ring + 0.01 * drawn(frame_.rows())));
}

TEST_F(OneResonance, IsNotLookedForWhereNoTimePasses) {
  const ArrayXd ring = 0.1 * (place_of(frame_, torque_, kFrequency, kDamping) - torque_);
  frame_.interval = 0.0;
  EXPECT_FALSE(found(ring));
  frame_.interval = 2e-3;
  frame_.duration = 0.0;
  EXPECT_FALSE(found(ring));
}

}  // namespace
}  // namespace flexspline::studies
