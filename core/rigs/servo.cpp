#include <algorithm>

#include "rigs/implicit_root.hpp"
#include "rigs/servo_feed.hpp"
#include "rigs/two_masses.hpp"

namespace flexspline {
namespace {

// States theta, omega at the output (, current). The transmission is rigid; effects there oppose
// the motion of the output, which is its torsion.
struct ServoDrive {
  DriveModel model;
  RigInputs inputs;
  std::vector<RigVariable> variables;
  Feed feed = Feed::torque;

  template <class S>
  Instant<S> rates(double t, std::span<const S> y, std::span<const S> p, std::span<S> ydot) const {
    const std::size_t own = variables.size();
    const DriveAt<S> at(model, p, y.subspan(own));
    Instant<S> x = start<S>(t, y);
    if (feed == Feed::torque) {
      x.motor_torque_rate = S(rate_of(input(inputs, Quantity::motor_torque), t));
    }
    at.set_motor_torque(x, motor_torque(at, x, t, y));
    const S acceleration = solve(at, x, t, y, p);
    surplus(at, x, acceleration, t);
    ydot[0] = y[1];
    ydot[1] = acceleration;
    if (feed == Feed::winding) ydot[2] = winding_rate(at, inputs, x, t, y[2]);
    at.memory_rates(start<S>(t, y), x, ydot.subspan(own));
    return x;
  }

 private:
  template <class S, class T>
  Instant<S> start(double t, std::span<const T> y) const {
    Instant<S> x;
    x.time = S(t);
    x.gear_ratio = model.drive().gear_ratio;
    x.load_angle = x.torsion = value_as<S>(y[0]);
    x.load_speed = x.torsion_rate = value_as<S>(y[1]);
    x.motor_angle = x.gear_ratio * x.load_angle;
    x.motor_speed = x.gear_ratio * x.load_speed;
    return x;
  }

  template <class S, class T>
  static S value_as(const T& v) {
    if constexpr (std::is_same_v<S, T>) {
      return v;
    } else {
      return real_part(v);
    }
  }

  template <class S>
  S motor_torque(const DriveAt<S>& at, const Instant<S>& x, double t, std::span<const S> y) const {
    if (feed == Feed::winding) return at.constant(&DriveSpec::torque_constant) * y[2];
    return fed_torque(at, inputs, feed, x, t);
  }

  // N (tau_m - J1 N a - losses) - tau - effects, with tau = J2 a + load; x is completed on the way.
  template <class S>
  S surplus(const DriveAt<S>& at, Instant<S>& x, const S& a, double t) const {
    x.load_acceleration = x.torsion_acceleration = a;
    x.motor_acceleration = x.gear_ratio * a;
    x.transmitted_torque = at.constant(&DriveSpec::load_inertia) * a + at.load_torque(x);
    if (inputs.load_torque) x.transmitted_torque += S(inputs.load_torque->value(t));
    const S inertia = at.constant(&DriveSpec::motor_inertia) * x.motor_acceleration;
    const S motor = x.gear_ratio * (x.motor_torque - inertia - at.motor_losses(x));
    return motor - x.transmitted_torque - at.sum(Site::transmission, x);
  }

  // Friction that grows with the torque transmitted makes the acceleration implicit.
  template <class S>
  S solve(const DriveAt<S>& at, Instant<S>& x, double t, std::span<const S> y,
          std::span<const S> p) const {
    const auto residual = [&](const S& a) { return -surplus(at, x, a, t); };
    if constexpr (std::is_same_v<S, double>) {
      return secant_root(residual, 1.0);
    } else {
      return implicit_root<S>(plain_residual<double>(x, t, y, p),
                              plain_residual<Complex>(x, t, y, p), residual, 1.0);
    }
  }

  // What solve makes zero, without the derivatives that S carries.
  template <class R, class S>
  auto plain_residual(const Instant<S>& x, double t, std::span<const S> y,
                      std::span<const S> p) const {
    Instant<R> z = start<R>(t, y);
    z.motor_torque = R(real_part(x.motor_torque));
    z.motor_torque_rate = R(real_part(x.motor_torque_rate));
    return [this, t, z, memory = real_parts<R>(y.subspan(variables.size())),
            parameters = real_parts<R>(p)](const R& a) mutable {
      return -surplus(DriveAt<R>(model, parameters, memory), z, a, t);
    };
  }
};

// States theta_m, omega_m, theta_l, omega_l (, torsion of the law): the torsion between motor and
// load that a servo's encoder does not see.
struct CompliantServo {
  DriveModel model;
  RigInputs inputs;
  std::vector<RigVariable> variables;
  Feed feed = Feed::torque;

  template <class S>
  Instant<S> rates(double t, std::span<const S> y, std::span<const S> p, std::span<S> ydot) const {
    const std::size_t own = variables.size();
    const DriveAt<S> at(model, p, y.subspan(own));
    Instant<S> x = two_masses(model, t, y);
    if (feed == Feed::torque) {
      x.motor_torque_rate = S(rate_of(input(inputs, Quantity::motor_torque), t));
    }
    at.set_motor_torque(x, fed_torque(at, inputs, feed, x, t));
    const Instant<S> rigid = enter_transmission(at, x, y[own - 1]);
    accelerate(at, inputs, x, rigid, t);
    ydot[0] = y[1];
    ydot[1] = x.motor_acceleration;
    ydot[2] = y[3];
    ydot[3] = x.load_acceleration;
    if (model.torsion_is_state()) ydot[own - 1] = x.torsion_rate;
    at.memory_rates(rigid, x, ydot.subspan(own));
    return x;
  }
};

struct ServoForm {
  std::string_view id;
  Feed feed;
  bool compliant;
};

constexpr ServoForm kForms[] = {
    {"torque_driven", Feed::torque, false},        {"current_driven", Feed::current, false},
    {"voltage_driven", Feed::voltage, false},      {"winding", Feed::winding, false},
    {"position_loop", Feed::position_loop, false}, {"compliant", Feed::torque, true},
    {"compliant_current", Feed::current, true},    {"compliant_voltage", Feed::voltage, true}};

std::vector<std::string_view> positive_constants(const ServoForm& form) {
  std::vector<std::string_view> names = {"gear_ratio"};
  if (form.feed != Feed::torque && form.feed != Feed::current) names.push_back("resistance");
  if (form.feed == Feed::winding) names.push_back("inductance");
  if (form.compliant) names.insert(names.end(), {"motor_inertia", "load_inertia"});
  return names;
}

Result<std::unique_ptr<RigSystem>> make_compliant(DriveModel model, const RigInputs& inputs,
                                                  const RigForm& form, Feed feed) {
  if (auto good = model.check_yielding(); !good) return tl::unexpected(good.error());
  auto states = states_with_kinematics(model, form);
  return std::make_unique<RigSystemOf<CompliantServo>>(
      CompliantServo{std::move(model), inputs, std::move(states), feed});
}

Result<std::unique_ptr<RigSystem>> make(const DriveSpec& drive, const RigInputs& inputs,
                                        std::string_view name) {
  const RigRow& row = rig_row(Rig::servo);
  const auto* found = name.empty() ? kForms : std::ranges::find(kForms, name, &ServoForm::id);
  const ServoForm& wanted = found == std::end(kForms) ? kForms[0] : *found;
  const auto form = checked_form(row, drive, inputs, name, positive_constants(wanted));
  if (!form) return tl::unexpected(form.error());
  if (wanted.feed == Feed::position_loop && !inputs.position_gain) {
    return failure(ErrorCode::input_missing, "the servo's position loop is given no gain",
                   "give position_gain, the duty cycle a radian of error");
  }
  if (!(reflected_inertia(drive) + drive.load_inertia > 0.0)) {
    return failure(ErrorCode::bad_data, "servo: neither motor_inertia nor load_inertia is positive",
                   "give the inertia that turns");
  }
  auto model = DriveModel::make(drive, row.constants, {Site::motor_torque_signal});
  if (!model) return tl::unexpected(model.error());
  if (wanted.compliant) return make_compliant(std::move(*model), inputs, **form, wanted.feed);
  if (model->has(Site::kinematics)) {
    return failure(ErrorCode::bad_data,
                   fmt::format("in the servo's form {} the transmission is rigid: an effect of the "
                               "kinematics has no torsion to add to",
                               (*form)->id),
                   "use its form compliant, compliant_current or compliant_voltage, or take the "
                   "effect out of the model");
  }
  return std::make_unique<RigSystemOf<ServoDrive>>(
      ServoDrive{std::move(*model), inputs, (*form)->states, wanted.feed});
}

}  // namespace

RigRow describe_servo() {
  const std::vector<RigVariable> states = {{"load_angle", "rad", "theta at the output"},
                                           {"load_speed", "rad/s", "omega at the output"}};
  auto winding = states;
  winding.push_back({"current", "A", "in the winding"});
  const std::vector<RigVariable> two = {{"motor_angle", "rad", "theta_m"},
                                        {"motor_speed", "rad/s", "at the motor"},
                                        {"load_angle", "rad", "theta_l"},
                                        {"load_speed", "rad/s", "at the output"}};
  const std::vector<Quantity> bridge = {Quantity::duty_cycle, Quantity::supply_voltage};
  return {
      .id = "servo",
      .rig = Rig::servo,
      .says = "one encoder, a pendulum or inertial load, no torque sensor; no torsion view",
      .equations =
          "(N^2 J1 + J2) theta'' + (N^2 B1 + B2) theta' + N tau_f + m g l sin(theta) = "
          "N tau_m, (5) and (6) with phi = 0; tau_m = kt i, "
          "L i' = V - R i - ke omega_m, V = duty supply; compliant: (5)-(8)",
      .not_modelled =
          "torsion, and kinematics with it, but for the compliant forms; sag of the supply beyond "
          "what supply_voltage records",
      .forms = {{"torque_driven", "by motor_torque", states, {Quantity::motor_torque}},
                {"current_driven", "tau_m = kt i", states, {Quantity::current}},
                {"voltage_driven", "tau_m = kt (V - ke omega)/R", states, bridge},
                {"winding", "with the inductance of the winding", winding, bridge},
                {"position_loop",
                 "V = supply clamp(kp (commanded_angle - theta), -1, 1)",
                 states,
                 {Quantity::commanded_angle, Quantity::supply_voltage}},
                {"compliant", "eqs. (5)-(8) by motor_torque", two, {Quantity::motor_torque}},
                {"compliant_current", "eqs. (5)-(8), tau_m = kt i", two, {Quantity::current}},
                {"compliant_voltage", "eqs. (5)-(8), tau_m = kt (V - ke omega)/R", two, bridge}},
      .constants =
          constants_named({"motor_inertia", "motor_viscous", "motor_coulomb", "coulomb_width",
                           "load_inertia", "load_viscous", "load_mass", "arm_length",
                           "torque_constant", "resistance", "inductance", "back_emf"}),
      .outputs = {Quantity::load_angle, Quantity::velocity, Quantity::motor_torque},
      .residuals = {"drive"},
      .make = make};
}

}  // namespace flexspline
