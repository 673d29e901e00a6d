#include "rigs/rig_parts.hpp"
#include "rigs/two_masses.hpp"

namespace flexspline {
namespace {

// States theta_m, omega_m, theta_l, omega_l (, integral of the loop) (, torsion of the law).
struct FreeDrive {
  DriveModel model;
  RigInputs inputs;
  std::vector<RigVariable> variables;
  bool loop = false;

  template <class S>
  Instant<S> rates(double t, std::span<const S> y, std::span<const S> p, std::span<S> ydot) const {
    const std::size_t own = variables.size();
    const DriveAt<S> at(model, p, y.subspan(own));
    Instant<S> x = two_masses(model, t, y);
    drive_motor(at, model.drive(), inputs, loop, x, t, loop ? y[4] : S(0.0));
    const Instant<S> rigid = enter_transmission(at, x, y[own - 1]);
    accelerate(at, inputs, x, rigid, t);
    if (loop) x.motor_torque_rate = loop_rate(model.drive(), inputs, t, x, y[4]);
    ydot[0] = y[1];
    ydot[1] = x.motor_acceleration;
    ydot[2] = y[3];
    ydot[3] = x.load_acceleration;
    if (loop) ydot[4] = S(input(inputs, Quantity::commanded_angle).value(t) - y[0]);
    if (model.torsion_is_state()) ydot[own - 1] = x.torsion_rate;
    at.memory_rates(rigid, x, ydot.subspan(own));
    return x;
  }
};

Result<std::unique_ptr<RigSystem>> make(const DriveSpec& drive, const RigInputs& inputs,
                                        std::string_view name) {
  const RigRow& row = rig_row(Rig::free);
  const auto form =
      checked_form(row, drive, inputs, name, {"gear_ratio", "motor_inertia", "load_inertia"});
  if (!form) return tl::unexpected(form.error());
  auto model = DriveModel::make(drive, row.constants, {Site::motor_torque_signal},
                                name == "position_loop" ? TorqueFrom::loop : TorqueFrom::given);
  if (!model) return tl::unexpected(model.error());
  if (auto good = model->check_yielding(); !good) return tl::unexpected(good.error());
  auto states = states_with_kinematics(*model, **form);
  return std::make_unique<RigSystemOf<FreeDrive>>(
      FreeDrive{std::move(*model), inputs, std::move(states), name == "position_loop"});
}

}  // namespace

RigRow describe_free() {
  const std::vector<RigVariable> states = {{"motor_angle", "rad", "theta_m"},
                                           {"motor_speed", "rad/s", "at the motor"},
                                           {"load_angle", "rad", "theta_l"},
                                           {"load_speed", "rad/s", "at the output"}};
  auto held = states;
  held.push_back({"loop_integral", "rad s", "int (r - theta_m) dt"});
  return {.id = "free",
          .rig = Rig::free,
          .says = "inertial load on the output, both encoders",
          .equations =
              "J1 theta_m'' + B1 theta_m' + tau_f + tau (1/N + de/dtheta_m) = tau_m (5), "
              "J2 theta_l'' + B2 theta_l' + tau_L - tau (1 - de/dtheta_l) = 0 (6), "
              "tau = g^-1(phi'/h) + f (7), phi = theta_m/N - theta_l + e (8), e of the kinematics",
          .not_modelled = "mass between motor and load; play of the bearings",
          .forms = {{"motor_driven", "eqs. (5)-(8)", states, {Quantity::motor_torque}},
                    {"position_loop",
                     "the motor held to commanded_angle",
                     held,
                     {Quantity::commanded_angle}}},
          .constants =
              constants_named({"motor_inertia", "motor_viscous", "motor_coulomb", "coulomb_width",
                               "load_inertia", "load_viscous", "load_mass", "arm_length"}),
          .outputs = {Quantity::motor_angle, Quantity::load_angle, Quantity::transmitted_torque,
                      Quantity::motor_torque},
          .residuals = {"motor", "load", "torsion", "drive"},
          .make = make};
}

}  // namespace flexspline
