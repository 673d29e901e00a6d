// Effects that are passive under a condition, under it; and that every other one says why it is
// not.
#include <set>

#include "effect_terms.hpp"

namespace flexspline {
namespace {

// Shares of friction: passive beside the friction that they are part of, instant by instant.
const std::set<std::string_view> kBesideFriction = {"direction_asymmetry",
                                                    "position_dependent_friction"};
// Springs and errors that turn with a shaft: what they return to it closes the books of the rigs
// (FreeRig.StoresOrLosesWhatIsPutInWithItsKinematics).
const std::set<std::string_view> kOnTwoShafts = {"kinematic_error", "output_kinematic_error",
                                                 "load_dependent_kinematic_error",
                                                 "stiffness_ripple"};
// A constant in the torsion is not silent at rest, but returns all that it takes.
const std::set<std::string_view> kDatum = {"torsion_zero"};
// Springs of friction that the load stiffens while they are wound
// (PreslidingLoadFriction.GivesBackMoreOnlyForWhatTheLoadPutIn).
const std::set<std::string_view> kStiffenedByLoad = {"presliding_load_friction"};
// What is wrong with a motor that drives does work on it.
const std::set<std::string_view> kDriving = {"current_lag", "motor_torque_offset",
                                             "motor_torque_ripple", "torque_constant_error",
                                             "torque_saturation"};

TEST(Passivity, IsAskedOfEveryEffectThatIsNoInstrumentAndDoesNotDrive) {
  std::set<std::string_view> active;
  for (const EffectRow& row : effects()) {
    if (!row.passive && !on_instrument(row.site)) active.insert(row.id);
  }
  std::set<std::string_view> known = kDriving;
  known.insert(kBesideFriction.begin(), kBesideFriction.end());
  known.insert(kOnTwoShafts.begin(), kOnTwoShafts.end());
  known.insert(kDatum.begin(), kDatum.end());
  known.insert(kStiffenedByLoad.begin(), kStiffenedByLoad.end());
  EXPECT_EQ(active, known);
}

double least_power(const std::vector<std::pair<std::string, Parameters>>& friction) {
  std::mt19937_64 draw(5);
  double least = 0.0;
  for (int k = 0; k < 20000; ++k) {
    Instant<double> x = random_instant(draw);
    if (k % 2 == 0) x.motor_speed *= 0.02;
    double torque = 0.0;
    for (const auto& [id, parameters] : friction) torque += term_at(id, parameters, x);
    least = std::min(least, torque * x.motor_speed);
  }
  return least;
}

TEST(Passivity, OfAnAsymmetryHoldsBesideTheFrictionItIsHalfOf) {
  for (const double sign : {-1.0, 1.0}) {
    const std::pair<std::string, Parameters> asymmetry = {"direction_asymmetry",
                                                          {{"coulomb_difference", sign * 0.06},
                                                           {"viscous_difference", sign * 6e-4},
                                                           {"smoothing", 0.5}}};
    const Parameters just = {{"coulomb", 0.06}, {"viscous", 6e-4}, {"smoothing", 0.5}};
    const Parameters less = {{"coulomb", 0.04}, {"viscous", 4e-4}, {"smoothing", 0.5}};
    EXPECT_GE(least_power({asymmetry, {"coulomb_viscous_friction", just}}), -1e-15);
    EXPECT_LT(least_power({asymmetry, {"coulomb_viscous_friction", less}}), -1e-3);
  }
}

TEST(Passivity, OfAFrictionOverTheAngleHoldsBesideItsMean) {
  const std::pair<std::string, Parameters> waves = {"position_dependent_friction",
                                                    {{"order", 2.0},
                                                     {"sine", 0.03},
                                                     {"cosine", 0.0},
                                                     {"smoothing", 0.5},
                                                     {"order", 1.0},
                                                     {"sine", 0.0},
                                                     {"cosine", 0.02},
                                                     {"smoothing", 0.5}}};
  const Parameters just = {{"coulomb", 0.05}, {"viscous", 0.0}, {"smoothing", 0.5}};
  const Parameters less = {{"coulomb", 0.03}, {"viscous", 0.0}, {"smoothing", 0.5}};
  EXPECT_GE(least_power({waves, {"coulomb_viscous_friction", just}}), -1e-15);
  EXPECT_LT(least_power({waves, {"coulomb_viscous_friction", less}}), -1e-3);
}

double cycle_work(const Path& path, const std::vector<double>& torque, std::size_t per_cycle) {
  double net = 0.0;
  double moved = 0.0;
  for (std::size_t i = per_cycle; i < 2 * per_cycle; ++i) {
    net += torque[i] * path[i].torsion_rate;
    moved += std::abs(torque[i] * path[i].torsion_rate);
  }
  return net / moved;
}

// d v = 9 C is the edge that the row states; speeds around v, where damping and bristles meet.
TEST(Passivity, OfBristlesWithDampingHoldsUpToItsEdge) {
  constexpr double kCoulomb = 4.5;
  for (const double rate : {1e-4, 1e-3, 1e-2}) {
    for (const double stribeck : {0.0, 0.5, 3.0}) {
      const Parameters edge = {{"stiffness", 1.5e4},
                               {"coulomb", kCoulomb},
                               {"stribeck", stribeck},
                               {"stribeck_rate", rate},
                               {"damping", 9.0 * kCoulomb / rate}};
      for (const double period : {0.1, 1.0, 10.0, 100.0}) {
        const auto path = drive_path(period, 4000, 2);
        EXPECT_GE(cycle_work(path, terms_of("lugre_torsion", edge, path), 4000), -1e-9)
            << rate << " rad/s, " << stribeck << " Nm, " << period << " s";
      }
    }
  }
}

// A gap before a spring: what is lost is a function of the torsion alone, and so is the torque.
TEST(Passivity, OfAGapIsThatOfItsOwnTorque) {
  constexpr double kStiffness = 1.5e5;
  const auto path = drive_path(1.0, 4000, 2);
  auto torque = terms_of("backlash", {{"half_gap", 3e-4}, {"rounding", 2e-5}}, path);
  for (std::size_t i = 0; i < path.size(); ++i) {
    torque[i] = kStiffness * (path[i].torsion + torque[i]);
  }
  EXPECT_NEAR(cycle_work(path, torque, 4000), 0.0, 1e-9);
}

}  // namespace
}  // namespace flexspline
