#include <algorithm>
#include <cmath>
#include <complex>

#include <fmt/format.h>

#include "export/c_model.hpp"
#include "export/carrier.hpp"
#include "export/filled.hpp"
#include "export/inertia_there.hpp"
#include "export/law_fits.hpp"
#include "export/mjcf_friction.hpp"
#include "export/xml.hpp"

namespace flexspline::data {
namespace {

constexpr double kTimestep = 1e-4;
constexpr double kBristleStep = 2e-5;  // Euler's error with bristles falls with the step
constexpr double kAbrupt = 1e-3;  // width of the sign of a friction loss over that of the model

double parameter(const EffectSpec& effect, std::string_view name) {
  for (const auto& [key, value] : effect.parameters) {
    if (key == name) return value;
  }
  return 0.0;
}

double sum_of(const DriveSpec& drive, std::string_view effect, std::string_view name) {
  double sum = 0.0;
  for (const EffectSpec& one : drive.torsion.effects) {
    if (one.effect == effect && !one.across) sum += parameter(one, name);
  }
  return sum;
}

std::string no_place(const EffectRow& row, const EffectSpec& effect) {
  constexpr std::string_view kHeld[] = {"coulomb_viscous_friction", "gravity_load",
                                        "motor_torque_offset", "torque_constant_error"};
  if (std::ranges::find(kHeld, row.id) == std::end(kHeld))
    return no_place_for_friction(row, effect);
  return effect.across ? "a friction across the transmission has no attribute" : std::string();
}

bool has_dry_friction(const RigModel& model) {
  const DriveSpec& d = model.drive;
  return d.motor_coulomb > 0.0 || sum_of(d, "coulomb_viscous_friction", "coulomb") > 0.0;
}

void make_abrupt(RigModel& model) {
  DriveSpec& d = model.drive;
  d.coulomb_width *= kAbrupt;
  for (EffectSpec& one : d.torsion.effects) {
    if (one.effect != "coulomb_viscous_friction") continue;
    for (auto& [name, value] : one.parameters) {
      if (name == "smoothing") value *= kAbrupt;
    }
  }
}

Result<Carried> carry(const RigModel& model) {
  if (model.rig == Rig::specimen) {
    return failure(ErrorCode::bad_data, "a specimen has no shafts that a joint could be",
                   "export it as c99, fmu or table, or state its [rig]");
  }
  if (auto there = inertia_there(model, "MuJoCo"); !there) return tl::unexpected(there.error());
  Carrier carrier(model);
  carrier.drop_instruments();
  carrier.drop_effects(no_place);
  const ModelSpec& laws = model.drive.torsion;
  const auto f = cubic_spring(laws.f);
  if (!f) return tl::unexpected(f.error());
  const auto g = cubic_damper(laws.g_inverse);
  if (!g) return tl::unexpected(g.error());
  carrier.change(
      "f beyond a x + c x^3", "a tendon's stiffness is that polynomial",
      [&](RigModel& m) { m.drive.torsion.f = *f; },
      [&](const RigModel& m) { return !(m.drive.torsion.f == *f); });
  carrier.change(
      "g^-1 beyond a v + b v|v| + c v^3", "a tendon's damping is that polynomial",
      [&](RigModel& m) { m.drive.torsion.g_inverse = *g; },
      [&](const RigModel& m) { return !(m.drive.torsion.g_inverse == *g); });
  carrier.change(
      "h", "a tendon's damping does not follow its length",
      [](RigModel& m) { m.drive.torsion.h.coefficients.clear(); },
      [](const RigModel& m) {
        return std::ranges::any_of(m.drive.torsion.h.coefficients,
                                   [](double c) { return c != 0.0; });
      });
  carrier.change("presliding of the motor's friction with a Stribeck part",
                 "LuGre's bristles, which hold the Stribeck part, give before they slip",
                 gather_in_bristles,
                 [](const RigModel& m) { return has_stribeck(m) && has_dry_friction(m); });
  carrier.drop_effects([](const EffectRow& row, const EffectSpec&) {
    return row.id == "stribeck_friction" ? std::string("without Coulomb friction it is not passive")
                                         : std::string();
  });
  carrier.change("the speed over which dry friction changes its sign",
                 "a friction loss is abrupt and sticks", make_abrupt, has_dry_friction);
  return std::move(carrier).done();
}

/// Weight of the load, of the pendulum and of effects together: M sin(theta + a).
std::complex<double> weight_of(const DriveSpec& d) {
  std::complex<double> sum = d.load_mass * d.gravity * d.arm_length;
  for (const EffectSpec& one : d.torsion.effects) {
    if (one.effect != "gravity_load") continue;
    sum += std::polar(parameter(one, "moment"), parameter(one, "phase"));
  }
  return sum;
}

/// A body's inertia about its hinge and the mass that weighs on it, on an arm short enough to leave
/// half the inertia.
std::string load_inertial(const DriveSpec& d, double inertia) {
  const std::complex<double> weight = weight_of(d);
  const double moment = std::abs(weight);
  const double longest = moment > 0.0 ? 0.5 * inertia * d.gravity / moment : 0.0;
  const double arm = d.arm_length > 0.0 ? std::min(d.arm_length, longest) : longest;
  const double mass = arm > 0.0 ? moment / (d.gravity * arm) : 1e-3;
  const double about_centre = inertia - mass * arm * arm;
  const double a = std::arg(weight);
  return fmt::format("<inertial pos=\"{} 0 {}\" mass=\"{}\" diaginertia=\"{} {} {}\"/>",
                     -arm * std::sin(a), -arm * std::cos(a), mass, about_centre, about_centre,
                     about_centre);
}

std::string friction(double level) {
  if (!(level > 0.0)) return {};
  return fmt::format(
      " frictionloss=\"{}\" solreffriction=\"0.001 1\" solimpfriction=\"0.995 0.995 0.001 0.5 2\"",
      level);
}

std::string polynomial(const LawSpec& law) {
  const auto [a, b, c] = polynomial_of(law);
  return fmt::format("{} {} {}", a, b, c);
}

double motor_friction(const DriveSpec& d) {
  return d.motor_coulomb + sum_of(d, "coulomb_viscous_friction", "coulomb");
}

double motor_viscous(const DriveSpec& d) {
  return d.motor_viscous + sum_of(d, "coulomb_viscous_friction", "viscous");
}

std::string two_bodies(const DriveSpec& d, bool load) {
  std::string text = fmt::format(
      "    <body name=\"motor\">\n"
      "      <inertial pos=\"0 0 0\" mass=\"0.001\" diaginertia=\"{0} {0} {0}\"/>\n"
      "      <joint name=\"motor\" type=\"hinge\" axis=\"0 1 0\" damping=\"{1}\"{2}/>\n"
      "    </body>\n",
      d.motor_inertia, motor_viscous(d), friction(motor_friction(d)));
  if (!load) return text;
  return text + fmt::format(
                    "    <body name=\"load\">\n      {}\n"
                    "      <joint name=\"load\" type=\"hinge\" axis=\"0 1 0\" "
                    "damping=\"{}\"/>\n    </body>\n",
                    load_inertial(d, d.load_inertia), d.load_viscous);
}

std::string tendon(const DriveSpec& d, bool load) {
  return fmt::format(
      "    <fixed name=\"gear\" springlength=\"0\" stiffness=\"{}\" damping=\"{}\">\n"
      "      <joint joint=\"motor\" coef=\"{}\"/>\n{}    </fixed>\n",
      polynomial(d.torsion.f), polynomial(d.torsion.g_inverse), 1.0 / d.gear_ratio,
      load ? "      <joint joint=\"load\" coef=\"-1\"/>\n" : "");
}

std::string servo_body(const DriveSpec& d) {
  const double n = d.gear_ratio;
  return fmt::format(
      "    <body name=\"load\">\n      {}\n"
      "      <joint name=\"load\" type=\"hinge\" axis=\"0 1 0\" armature=\"{}\" "
      "damping=\"{}\"{}/>\n    </body>\n",
      load_inertial(d, std::max(d.load_inertia, 1e-9)), reflected_inertia(d),
      n * n * motor_viscous(d) + d.load_viscous, friction(n * motor_friction(d)));
}

std::string actuator(const DriveSpec& d, std::string_view joint, double gear) {
  const double gain = 1.0 + sum_of(d, "torque_constant_error", "error");
  const double offset = -sum_of(d, "motor_torque_offset", "offset");
  return fmt::format(
      "    <general name=\"motor_torque\" joint=\"{}\" gear=\"{}\" "
      "gainprm=\"{}\" biastype=\"affine\" biasprm=\"{} 0 0\"/>\n",
      joint, gear, gain, offset);
}

std::string head_text(const ExportHead& head, double timestep) {
  return fmt::format(
      "<mujoco model=\"{}\">\n  <!-- A harmonic drive, written by flexspline. SI: rad, Nm, s. The "
      "control is the motor's torque at its shaft.\n{} -->\n"
      "  <compiler angle=\"radian\" inertiafromgeom=\"false\"/>\n"
      "  <option timestep=\"{}\" integrator=\"Euler\" gravity=\"0 0 -9.80665\"/>\n",
      head.name, xml_comment(commented(head, "       ")), timestep);
}

Result<std::vector<ExportedFile>> write(const RigModel& model, const ExportHead& head) {
  const DriveSpec& d = model.drive;
  const bool servo = model.rig == Rig::servo;
  const bool load = model.rig == Rig::free;
  std::string text = head_text(head, has_bristles(d) ? kBristleStep : kTimestep) +
                     "  <worldbody>\n" + (servo ? servo_body(d) : two_bodies(d, load)) +
                     slip_bodies(d) + "  </worldbody>\n";
  const std::string tendons = (servo ? std::string() : tendon(d, load)) + slip_tendons(model);
  if (!tendons.empty()) text += "  <tendon>\n" + tendons + "  </tendon>\n";
  text += "  <actuator>\n" +
          (servo ? actuator(d, "load", d.gear_ratio) : actuator(d, "motor", 1.0)) +
          bristle_actuators(model) + "  </actuator>\n";
  return std::vector<ExportedFile>{{head.name + ".xml", text + "</mujoco>\n"}};
}

}  // namespace

ExporterRow describe_mjcf() {
  return {.id = "mjcf",
          .says = "joints, a tendon as the transmission and an actuator for MuJoCo",
          .carries =
              "ratio, inertias, weight, viscous and dry friction; f as a x + c x^3, g^-1 as "
              "a v + b v|v| + c v^3; offset of the motor's torque, error of its constant; friction "
              "with memory (Stribeck, LuGre, Dahl) as LuGre's bristles, slip elements",
          .not_carried =
              "h; other effects; the speed over which dry friction changes its sign; the "
              "fall of the bristles' damping with speed",
          .carry = carry,
          .write = write};
}

}  // namespace flexspline::data
