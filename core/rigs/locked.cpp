#include "rigs/enter_transmission.hpp"
#include "rigs/implicit_root.hpp"
#include "rigs/rig_parts.hpp"

namespace flexspline {
namespace {

// States theta_m, omega_m (, integral of the loop) (, torsion of the law); reduced: without
// omega_m.
struct LockedDrive {
  DriveModel model;
  RigInputs inputs;
  std::vector<RigVariable> variables;
  bool reduced = false;
  bool loop = false;

  template <class S>
  Instant<S> rates(double t, std::span<const S> y, std::span<const S> p, std::span<S> ydot) const {
    const std::size_t own = variables.size();
    const DriveAt<S> at(model, p, y.subspan(own));
    Instant<S> x = reduced ? reduced_instant<S>(at, t, y, p) : inertial_instant<S>(at, t, y);
    if (loop) x.motor_torque_rate = loop_rate(model.drive(), inputs, t, x, y[2]);
    const Instant<S> rigid = at_speed(x, x.motor_speed);
    ydot[0] = x.motor_speed;
    if (!reduced) ydot[1] = x.motor_acceleration;
    if (loop) ydot[2] = S(input(inputs, Quantity::commanded_angle).value(t) - y[0]);
    if (model.torsion_is_state()) ydot[own - 1] = x.torsion_rate;
    at.memory_rates(rigid, x, ydot.subspan(own));
    return x;
  }

 private:
  template <class S>
  Instant<S> start(double t, const S& motor_angle) const {
    Instant<S> x;
    x.time = S(t);
    x.gear_ratio = model.drive().gear_ratio;
    x.motor_angle = motor_angle;
    return x;
  }

  template <class S>
  static Instant<S> at_speed(Instant<S> x, const S& motor_speed) {
    x.motor_speed = motor_speed;
    x.torsion = x.motor_angle / x.gear_ratio;
    x.torsion_rate = motor_speed / x.gear_ratio;
    return x;
  }

  // tau_m - losses - tau (1/N + de/dtheta_m) at a motor speed; x is completed on the way.
  template <class S>
  S surplus(const DriveAt<S>& at, Instant<S>& x, const S& speed, const S& law_torsion) const {
    x = at_speed(x, speed);
    const Instant<S> rigid = enter_transmission(at, x, law_torsion);
    const S geared = x.transmitted_torque / x.gear_ratio + at.motor_reaction(rigid, x);
    return x.motor_torque - at.motor_losses(x) - geared;
  }

  // J phi'' + B phi' + tau(phi', phi) = tau_n, eqs. (9)-(14), written at the motor.
  template <class S>
  Instant<S> inertial_instant(const DriveAt<S>& at, double t, std::span<const S> y) const {
    Instant<S> x = at_speed(start(t, y[0]), y[1]);
    drive_motor(at, model.drive(), inputs, loop, x, t, loop ? y[2] : S(0.0));
    const S acceleration =
        surplus(at, x, y[1], y[variables.size() - 1]) / at.constant(&DriveSpec::motor_inertia);
    x.motor_acceleration = acceleration;
    x.torsion_acceleration = acceleration / x.gear_ratio;
    return x;
  }

  // Eq. (3): the speed at which nothing is left to accelerate with.
  template <class S>
  Instant<S> reduced_instant(const DriveAt<S>& at, double t, std::span<const S> y,
                             std::span<const S> p) const {
    Instant<S> x = start(t, y[0]);
    drive_motor(at, model.drive(), inputs, false, x, t, S(0.0));
    const auto memory = real_parts(y.subspan(variables.size()));
    const auto parameters = real_parts(p);
    const DriveAt<Complex> complex_at(model, parameters, memory);
    Instant<Complex> z = start(t, Complex(real_part(y[0])));
    z.motor_torque = Complex(real_part(x.motor_torque));
    const double scale = model.drive().gear_ratio * model.drive().torsion.g_inverse.scale;
    const S& torsion = y[variables.size() - 1];
    const Complex real_torsion(real_part(torsion));
    const S speed =
        implicit_root<S>([&](const Complex& v) { return -surplus(complex_at, z, v, real_torsion); },
                         [&](const S& v) { return -surplus(at, x, v, torsion); }, scale);
    surplus(at, x, speed, torsion);
    return x;
  }
};

Result<std::unique_ptr<RigSystem>> make(const DriveSpec& drive, const RigInputs& inputs,
                                        std::string_view name) {
  const RigRow& row = rig_row(Rig::locked);
  const bool reduced = name == "reduced";
  const auto form = reduced
                        ? checked_form(row, drive, inputs, name, {"gear_ratio"})
                        : checked_form(row, drive, inputs, name, {"gear_ratio", "motor_inertia"});
  if (!form) return tl::unexpected(form.error());
  auto model = DriveModel::make(drive, row.constants, {Site::motor_torque_signal},
                                name == "position_loop" ? TorqueFrom::loop : TorqueFrom::given);
  if (!model) return tl::unexpected(model.error());
  if (auto good = model->check_yielding(); !good) return tl::unexpected(good.error());
  if (reduced && model->torsion_is_state() && !(drive.motor_viscous > 0.0)) {
    return failure(ErrorCode::bad_data,
                   "locked, reduced: with compliance in series and neither inertia nor viscous "
                   "friction at the motor its speed has no root",
                   "give a motor_viscous above 0, or use the form inertial");
  }
  auto states = states_with_kinematics(*model, **form);
  return std::make_unique<RigSystemOf<LockedDrive>>(
      LockedDrive{std::move(*model), inputs, std::move(states), reduced, name == "position_loop"});
}

}  // namespace

RigRow describe_locked() {
  const RigVariable angle{"motor_angle", "rad", "theta_m = N phi"};
  const RigVariable speed{"motor_speed", "rad/s", "at the motor"};
  return {.id = "locked",
          .rig = Rig::locked,
          .says = "output locked, motor position-controlled: the paper's bench",
          .equations =
              "J phi'' + B phi' + tau(phi', phi) = tau_n, phi = theta_m/N, J = N^2 J1, "
              "B = N^2 B1, tau_n = N (tau_m - tau_f), eqs. (9)-(14); kinematics e add to phi of "
              "the law and tau N de/dtheta_m to the left",
          .not_modelled = "give of the lock, but for series_compliance as an effect",
          .forms = {{"inertial", "eq. (11)", {angle, speed}, {Quantity::motor_torque}},
                    {"reduced", "eq. (3): inertia dropped", {angle}, {Quantity::motor_torque}},
                    {"position_loop",
                     "the motor held to commanded_angle",
                     {angle, speed, {"loop_integral", "rad s", "int (r - theta_m) dt"}},
                     {Quantity::commanded_angle}}},
          .constants =
              constants_named({"motor_inertia", "motor_viscous", "motor_coulomb", "coulomb_width"}),
          .outputs = {Quantity::motor_angle, Quantity::transmitted_torque, Quantity::motor_torque},
          .residuals = {"motor", "torsion"},
          .make = make};
}

}  // namespace flexspline
