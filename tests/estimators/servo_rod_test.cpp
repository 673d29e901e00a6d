// What the mass of a servo's arm changes, and what tells it.
#include <cmath>

#include <gtest/gtest.h>

#include "servo/servo_session.hpp"
#include "servo_pendulum.hpp"

namespace flexspline::estimators {
namespace {

/// The rates of a servo's states at its unknowns, the arm being a rod.
class RodSession {
 public:
  explicit RodSession(const ModelSpec& model) {
    DriveSpec d = drive();
    d.torsion = model;
    d = with_weight_as_effect(d);
    const Recording one = recording("fast", 0.8, 5.0);
    clock_ = *servo_clock({&one}, ServoDuty::recorded);
    auto rig = *make_rig(Rig::servo, d, clock_.inputs, "voltage_driven");
    unknowns_ = servo_unknowns(d, rig->parameter_list(), *given_parameters({model, {}, {}}),
                               {.arm = ServoArm::rod});
    session_ = std::make_unique<ServoSession>(std::move(rig), unknowns_.targets);
  }
  const std::vector<OdeParameter>& unknowns() const { return unknowns_.parameters; }
  double acceleration(double t, std::vector<double> y, const std::vector<double>& p) const {
    std::vector<double> rate(2);
    session_->rate(t, y, p, rate);
    return rate[1];
  }

 private:
  ServoClock clock_;
  ServoUnknowns unknowns_;
  std::unique_ptr<ServoSession> session_;
};

double acceleration_with_rod(const RodSession& session, double t, double angle, double rod) {
  constexpr double kInertia = 0.002;
  constexpr double kLoad = 0.005;
  const double scale = 1.0 + 0.5 * rod / 0.5;
  std::vector<double> p;
  for (const OdeParameter& one : session.unknowns()) {
    double value = one.start;
    if (one.name == "arm_mass") value = rod;
    if (one.name == "resistance") value = 4.0 / scale;
    if (one.name == "motor_inertia") value = scale * (kInertia + kLoad) - kLoad - rod / 3.0 * 0.01;
    if (one.name.ends_with("coulomb") || one.name.ends_with("viscous")) value *= scale;
    p.push_back(value);
  }
  return session.acceleration(t, {angle, 0.7}, p);
}

// A rod of mass m_a adds m_a/2 to the weight and m_a/3 to the inertia. With friction, 1/R and the
// whole inertia in the same proportion as the weight nothing moves differently, but for friction
// that grows with the load, which sees the load's inertia by itself.
TEST(ServoRod, TellsTheArmsMassByFrictionThatGrowsWithTheLoadAlone) {
  const RodSession without(friction(0.03, 0.01, 0.0));
  const RodSession with(friction(0.03, 0.01, 0.2));
  for (const double t : {0.3, 1.1, 2.9}) {
    for (const double angle : {-0.8, 0.2, 1.3}) {
      const double massless = acceleration_with_rod(without, t, angle, 0.0);
      EXPECT_NEAR(acceleration_with_rod(without, t, angle, 0.2), massless,
                  1e-9 * std::abs(massless));
      const double loaded = acceleration_with_rod(with, t, angle, 0.0);
      EXPECT_GT(std::abs(acceleration_with_rod(with, t, angle, 0.2) - loaded),
                1e-6 * std::abs(loaded));
    }
  }
}

}  // namespace
}  // namespace flexspline::estimators
