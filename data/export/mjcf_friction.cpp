#include "export/mjcf_friction.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "flexspline/core/effect_path.hpp"

namespace flexspline::data {
namespace {

constexpr double kSwing = 300.0;     // rad/s
constexpr double kLightness = 1e-6;  // inertia of a slip element's hinge over its stiffness, s2
constexpr double kDahlSpeed = 1.0;   // where the level is one the Stribeck speed is of no matter
constexpr std::string_view kAcross = "gear";

double parameter(const EffectSpec& effect, std::string_view name) {
  const auto found =
      std::ranges::find(effect.parameters, name, &std::pair<std::string, double>::first);
  return found == effect.parameters.end() ? 0.0 : found->second;
}

/// Bristles between a shaft and the frame, or across the transmission.
struct Bristles {
  bool at_motor = false;
  double stiffness = 0.0, damping = 0.0, coulomb = 0.0, excess = 0.0, speed = kDahlSpeed;
};

std::vector<Bristles> bristles_of(const DriveSpec& drive) {
  std::vector<Bristles> list;
  for (const EffectSpec& e : drive.torsion.effects) {
    const auto p = [&](std::string_view name) { return parameter(e, name); };
    if (e.effect == "lugre_friction") {
      list.push_back({!e.across, p("coulomb") / p("slip_length"), p("damping"), p("coulomb"),
                      p("excess"), p("stribeck_speed")});
    }
    if (e.effect == "lugre_torsion") {
      list.push_back(
          {false, p("stiffness"), p("damping"), p("coulomb"), p("stribeck"), p("stribeck_rate")});
    }
    if (e.effect == "dahl_hysteresis" || e.effect == "bouc_wen") {
      list.push_back({false, p("height") / p("slip_length"), 0.0, p("height")});
    }
  }
  return list;
}

struct Slip {
  double stiffness = 0.0;
  double yield = 0.0;
};

std::vector<Slip> slips_of(const DriveSpec& drive) {
  std::vector<Slip> list;
  for (const EffectSpec& effect : drive.torsion.effects) {
    if (effect.effect != "presliding_hysteresis") continue;
    for (std::size_t k = 0; k + 1 < effect.parameters.size(); k += 2) {
      const Slip one{effect.parameters[k].second, effect.parameters[k + 1].second};
      if (one.stiffness > 0.0) list.push_back(one);
    }
  }
  return list;
}

bool is_dry(const EffectSpec& effect) {
  return !effect.across &&
         (effect.effect == "stribeck_friction" ||
          (effect.effect == "coulomb_viscous_friction" && parameter(effect, "coulomb") > 0.0));
}

/// The torsion in terms of the joints.
std::string joints_across(const RigModel& model) {
  if (model.rig == Rig::servo) return "      <joint joint=\"load\" coef=\"1\"/>\n";
  return fmt::format("      <joint joint=\"motor\" coef=\"{}\"/>\n{}", 1.0 / model.drive.gear_ratio,
                     model.rig == Rig::free ? "      <joint joint=\"load\" coef=\"-1\"/>\n" : "");
}

}  // namespace

std::string no_place_for_friction(const EffectRow& row, const EffectSpec& effect) {
  if (row.id == "bouc_wen" && parameter(effect, "exponent") != 1.0) {
    return "LuGre's bristles are Bouc and Wen's law at exponent 1 alone";
  }
  if (row.id == "stribeck_friction") {
    if (effect.across) return "a Stribeck friction across the transmission has no attribute";
    return parameter(effect, "exponent") == 2.0
               ? std::string()
               : "LuGre's bristles have a Stribeck curve of exponent 2 alone";
  }
  constexpr std::string_view kHeld[] = {"lugre_friction", "lugre_torsion", "dahl_hysteresis",
                                        "bouc_wen", "presliding_hysteresis"};
  return std::ranges::find(kHeld, row.id) != std::end(kHeld) ? std::string()
                                                             : "MJCF has no attribute for it";
}

bool has_stribeck(const RigModel& model) {
  return std::ranges::any_of(model.drive.torsion.effects, [](const EffectSpec& e) {
    return e.effect == "stribeck_friction" && !e.across;
  });
}

void gather_in_bristles(RigModel& model) {
  DriveSpec& d = model.drive;
  double coulomb = d.motor_coulomb;
  double excess = 0.0;
  double speed = kDahlSpeed;
  for (EffectSpec& e : d.torsion.effects) {
    if (!is_dry(e)) continue;
    if (e.effect == "stribeck_friction") {
      excess += parameter(e, "excess");
      speed = parameter(e, "stribeck_speed");
    } else {
      coulomb += parameter(e, "coulomb");
      d.motor_viscous += parameter(e, "viscous");
    }
  }
  std::erase_if(d.torsion.effects, is_dry);
  d.motor_coulomb = 0.0;
  const double stiffness = std::max(d.motor_inertia, 1e-9) * kSwing * kSwing;
  d.torsion.effects.push_back({"lugre_friction",
                               {{"coulomb", coulomb},
                                {"excess", excess},
                                {"stribeck_speed", speed},
                                {"slip_length", coulomb / stiffness},
                                {"damping", 0.0}}});
}

bool has_bristles(const DriveSpec& drive) { return !bristles_of(drive).empty(); }

std::string slip_bodies(const DriveSpec& drive) {
  std::string text;
  int k = 0;
  for (const Slip& one : slips_of(drive)) {
    text += fmt::format(
        "    <body name=\"slip{0}\">\n"
        "      <inertial pos=\"0 0 0\" mass=\"0.001\" diaginertia=\"{1} {1} {1}\"/>\n"
        "      <joint name=\"slip{0}\" type=\"hinge\" axis=\"0 1 0\" frictionloss=\"{2}\" "
        "solreffriction=\"0.001 1\" solimpfriction=\"0.9999 0.9999 0.001 0.5 2\"/>\n"
        "    </body>\n",
        k++, kLightness * one.stiffness, one.stiffness * one.yield);
  }
  return text;
}

std::string slip_tendons(const RigModel& model) {
  std::string text;
  int k = 0;
  for (const Slip& one : slips_of(model.drive)) {
    text += fmt::format(
        "    <fixed name=\"slip{0}\" springlength=\"0\" stiffness=\"{1}\">\n{2}"
        "      <joint joint=\"slip{0}\" coef=\"-1\"/>\n    </fixed>\n",
        k++, one.stiffness, joints_across(model));
  }
  return text;
}

std::string bristle_actuators(const RigModel& model) {
  const bool servo = model.rig == Rig::servo;
  std::string text;
  int k = 0;
  for (const Bristles& one : bristles_of(model.drive)) {
    const std::string where = servo          ? fmt::format("joint=\"load\" gear=\"{}\"",
                                                  one.at_motor ? model.drive.gear_ratio : 1.0)
                              : one.at_motor ? std::string("joint=\"motor\"")
                                             : fmt::format("tendon=\"{}\"", kAcross);
    text += fmt::format(
        "    <dcmotor name=\"friction{}\" {} motorconst=\"1e-6\" resistance=\"1e6\" "
        "input=\"none\" lugre=\"{} {} {} {} {}\"/>\n",
        k++, where, one.stiffness, one.damping, one.coulomb, one.coulomb + one.excess, one.speed);
  }
  return text;
}

}  // namespace flexspline::data
