#include "rigs/implicit_root.hpp"
#include "rigs/imposed_motion.hpp"
#include "rigs/rig_parts.hpp"

namespace flexspline {
namespace {

// State phi: the motion is motor, load and torsion at once. Effects at motor, load and transmission
// add to the effort, and see the torque of the torsion law, as in simulate_torque.
struct Specimen {
  DriveModel model;
  RigInputs inputs;
  std::vector<RigVariable> variables;
  Quantity effort = Quantity::transmitted_torque;

  template <class S>
  Instant<S> rates(double t, std::span<const S> y, std::span<const S> p, std::span<S> ydot) const {
    const DriveAt<S> at(model, p, y.subspan(1));
    const auto memory = real_parts(y.subspan(1));
    const auto parameters = real_parts(p);
    const DriveAt<Complex> complex_at(model, parameters, memory);
    const double wanted = input(inputs, effort).value(t);
    Instant<Complex> z = start(t, Complex(real_part(y[0])));
    Instant<S> x = start(t, y[0]);
    const S speed =
        implicit_root<S>([&](const Complex& v) { return recorded(complex_at, z, v) - wanted; },
                         [&](const S& v) { return recorded(at, x, v) - S(wanted); },
                         model.drive().torsion.g_inverse.scale);
    recorded(at, x, speed);
    if (model.sensor_remembers()) {
      x.transmitted_torque_rate = at.true_torque_rate(x, rate_of(input(inputs, effort), t));
    }
    ydot[0] = speed;
    Instant<S> rigid = at_speed(start(t, y[0]), speed);
    enter_torque(at, rigid);
    at.memory_rates(rigid, x, ydot.subspan(1));
    return x;
  }

 private:
  template <class S>
  static Instant<S> start(double t, const S& motion) {
    Instant<S> x;
    x.time = S(t);
    x.motor_angle = x.load_angle = x.torsion = motion;
    return x;
  }

  template <class S>
  static Instant<S> at_speed(Instant<S> x, const S& v) {
    x.motor_speed = x.load_speed = x.torsion_rate = v;
    return x;
  }

  // For kinematics that follow the torque: the true one behind the recorded one, and its rate.
  template <class S>
  void enter_torque(const DriveAt<S>& at, Instant<S>& x) const {
    if (!at.model().kinematics_follow_torque()) return;
    const double t = real_part(x.time);
    x.transmitted_torque = S(input(inputs, effort).value(t));
    x.transmitted_torque_rate = S(rate_of(input(inputs, effort), t));
    at.undo_torque_sensor(x);
  }

  // The effort that a bench would record at this speed; x holds the true one afterwards.
  template <class S>
  S recorded(const DriveAt<S>& at, Instant<S>& x, const S& v) const {
    x.torsion = x.motor_angle;
    x = at_speed(x, v);
    enter_torque(at, x);
    at.add_kinematics(x);
    x.transmitted_torque = SpecimenTorque{}(at, x);
    return x.transmitted_torque + at.sum(Site::torque_signal, x);
  }
};

// The inputs with torque and motion under the name that the equations have for them.
RigInputs in_one_name(RigInputs inputs) {
  constexpr std::pair<Quantity, Quantity> kNames[] = {
      {Quantity::torque, Quantity::transmitted_torque},
      {Quantity::force, Quantity::transmitted_torque},
      {Quantity::angle, Quantity::torsion},
      {Quantity::displacement, Quantity::torsion}};
  for (const auto& [other, own] : kNames) {
    const auto found = inputs.channels.find(other);
    if (found != inputs.channels.end()) inputs.channels.emplace(own, found->second);
  }
  return inputs;
}

Result<std::unique_ptr<RigSystem>> make_moved(const RigForm& form, const DriveSpec& drive,
                                              RigInputs inputs) {
  auto model = DriveModel::make(drive, {}, {});
  if (!model) return tl::unexpected(model.error());
  if (auto good = model->check_yielding(); !good) return tl::unexpected(good.error());
  auto states = states_with_kinematics(*model, form);
  return std::make_unique<RigSystemOf<ImposedMotion>>(
      ImposedMotion{std::move(*model), std::move(inputs), std::move(states)});
}

Result<std::unique_ptr<RigSystem>> make(const DriveSpec& drive, const RigInputs& inputs,
                                        std::string_view name) {
  const RigRow& row = rig_row(Rig::specimen);
  RigInputs given = in_one_name(inputs);
  const auto form = checked_form(row, drive, given, name, {});
  if (!form) return tl::unexpected(form.error());
  if ((*form)->id == "displacement_driven") return make_moved(**form, drive, std::move(given));
  auto model = DriveModel::make(drive, row.constants, {Site::torque_signal}, TorqueFrom::recorded);
  if (!model) return tl::unexpected(model.error());
  return std::make_unique<RigSystemOf<Specimen>>(
      Specimen{std::move(*model), std::move(given), (*form)->states});
}

}  // namespace

RigRow describe_specimen() {
  return {.id = "specimen",
          .rig = Rig::specimen,
          .says = "anything whose force follows an imposed displacement",
          .equations =
              "phi' = h(phi) g(tau - f(phi)) (3), and displacement-driven "
              "tau = g^-1(phi'/h(phi)) + f(phi) (4); torsion in rad (displacement in m), torque in "
              "Nm (force in N)",
          .not_modelled = "mass of the specimen, but for inertia_torque when displacement-driven",
          .forms = {{"force_driven",
                     "eq. (3) with the effects' memory",
                     {{"motion", "rad", "phi, or m"}},
                     {Quantity::transmitted_torque}},
                    {"displacement_driven",
                     "eq. (4) with the effects' memory as functions of time; simulate_torque goes "
                     "from sample to sample",
                     {{"work", "J", "done on the specimen"}},
                     {Quantity::torsion}}},
          .constants = {},
          .outputs = {Quantity::torsion, Quantity::transmitted_torque},
          .residuals = {"torsion"},
          .make = make};
}

}  // namespace flexspline
