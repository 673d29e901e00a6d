#include "diagnosis/frame/coordinates.hpp"
#include "diagnosis/model/cause_columns.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Values = std::span<const double>;

std::vector<Shape> warming(const Frame& f) {
  return {{.name = "time_constant",
           .unit = "s",
           .lower = 0.05 * f.session,
           .upper = 4.0 * f.session,
           .grid = 4,
           .meaning = "in which it follows or settles"}};
}

Columns at_motor(Equation, const Frame& f, const Reference& known, Values shape) {
  const ArrayXd cold = cold_share(f, shape[0]);
  return {cold * known.motor_sign, cold * f.motor_speed / f.speed_range};
}

Columns at_joint(Equation, const Frame& f, const Reference& known, Values shape) {
  const ArrayXd cold = cold_share(f, shape[0]);
  return {cold * rounded_sign(f.torsion_rate, known.torsion_sign),
          cold * f.torsion_rate / f.rate_range};
}

Columns across(Equation, const Frame& f, const Reference& known, Values shape) {
  return {cold_share(f, shape[0]) * known.dissipative};
}

Counterpart warms(const FittedCause& c, std::span<const SignPart> sign, double fastest) {
  Counterpart counterpart{
      .effects = by_sign_part(sign, "thermal_friction_drift", [&](double share, double width) {
        return std::vector<std::pair<std::string, double>>{
            {"coulomb", share * c.coefficients[0]},
            {"viscous", share * c.coefficients[1] / fastest},
            {"time_constant", c.shape[0]},
            {"smoothing", width}};
      })};
  counterpart.caveat = kSessionClock;
  return counterpart;
}

Counterpart motor_warms(const FittedCause& c) {
  return warms(c, c.motor_sign, c.frame.speed_range);
}

Counterpart joint_warms(const FittedCause& c) {
  return warms(c, c.torsion_sign, c.frame.rate_range);
}

std::vector<Term> dry_and_viscous(const Frame&) {
  return {{"coulomb", "Nm", "dry friction when cold beyond the warm one's"},
          {"viscous", "Nm", "the same of the viscous friction at the largest speed"}};
}

std::vector<Term> gear_terms(const Frame&) {
  return {{"share", "1", "of the dissipative torque, by which it is larger when cold"}};
}

}  // namespace

CauseRow describe_thermal_friction_drift() {
  return {.id = "thermal_friction_drift",
          .coordinate = "time",
          .forms = {{.equation = "tau_f += (c sgn w + B w) exp(-t/T), t of the session",
                     .rigs = kMotors,
                     .at = {Equation::motor},
                     .shapes = warming,
                     .terms = dry_and_viscous,
                     .columns = at_motor,
                     .nonnegative = true,
                     .counterpart = motor_warms},
                    {.equation = "tau += (c sgn q' + B q') exp(-t/T), t of the session",
                     .rigs = {Rig::specimen},
                     .at = {Equation::torsion},
                     .shapes = warming,
                     .terms = dry_and_viscous,
                     .columns = at_joint,
                     .nonnegative = true,
                     .where = travels,
                     .counterpart = joint_warms},
                    {.equation = "tau += c g^-1(phi'/h) exp(-t/T), t of the session",
                     .rigs = {Rig::locked, Rig::specimen},
                     .at = {Equation::torsion},
                     .shapes = warming,
                     .terms = gear_terms,
                     .columns = across,
                     .nonnegative = true,
                     .where = wound_up,
                     .no_counterpart =
                         "the catalogue of effects warms up the motor's friction, not g^-1"}}};
}

}  // namespace flexspline::studies
