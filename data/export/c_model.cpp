#include "export/c_model.hpp"

#include <algorithm>
#include <cctype>
#include <map>

#include <fmt/format.h>

#include "export/c_effects.hpp"
#include "export/c_expression.hpp"
#include "export/c_law.hpp"
#include "export/c_texts.hpp"
#include "export/carrier.hpp"
#include "export/filled.hpp"

namespace flexspline::data {
namespace {

const CRigText& text_of(Rig rig) {
  switch (rig) {
    case Rig::free:
      return kCFree;
    case Rig::locked:
      return kCLocked;
    case Rig::servo:
      return kCServo;
    case Rig::specimen:
      break;
  }
  return kCSpecimen;
}

std::string upper(std::string text) {
  std::ranges::transform(text, text.begin(),
                         [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

constexpr std::string_view kInstant = R"(
typedef struct {
  double time, motor_angle, motor_speed, load_angle, load_speed, torsion, torsion_rate;
  double transmitted_torque, motor_torque, motor_torque_rate, gear_ratio;
} instant;

)";

constexpr std::string_view kLoadEquation =
    R"(  load = torque - torque * kinematics_by_load(&rigid, z) -
         x.torsion * transmission_by_load(&half, z) - WEIGHT * sin(x.load_angle) -
         B2 * x.load_speed - at_load(&x, z) - u->load_torque;
)";

constexpr std::string_view kBetweenTorques = R"(
static @name@_input between(const @name@_input *a, const @name@_input *b, double share) {
  @name@_input u;
  u.motor_torque = a->motor_torque + share * (b->motor_torque - a->motor_torque);
  u.load_torque = a->load_torque + share * (b->load_torque - a->load_torque);
  return u;
}

static double rise(const @name@_input *a, const @name@_input *b) {
  return b->motor_torque - a->motor_torque;
}
)";

// The torsion as a cubic through both values and rates.
constexpr std::string_view kBetweenMotions = R"(
static @name@_input between(const @name@_input *a, const @name@_input *b, double share) {
  @name@_input u;
  u.torsion = a->torsion + share * (b->torsion - a->torsion);
  u.torsion_rate = a->torsion_rate + share * (b->torsion_rate - a->torsion_rate);
  return u;
}

static double rise(const @name@_input *a, const @name@_input *b) {
  (void)a;
  (void)b;
  return 0.0;
}
)";

constexpr std::string_view kReset = R"(
void @name@_reset(@name@_state *state) { memset(state, 0, sizeof *state); }

void @name@_outputs(const @name@_state *state, const @name@_input *u, @name@_output *out) {
  double dy[SIZE];
  @name@_rates(state->time, state->y, u, 0.0, dy, out);
}
)";

std::string constants(const DriveSpec& d, const CRigText& rig, std::size_t states) {
  std::string text;
  const auto define = [&](std::string_view name, double value, std::string_view says) {
    text += fmt::format("#define {} {} /* {} */\n", name, c_number(value), says);
  };
  define("N", d.gear_ratio, "gear ratio");
  define("J1", d.motor_inertia, "kg m2, motor");
  define("B1", d.motor_viscous, "Nm s/rad, motor");
  define("C1", d.motor_coulomb, "Nm, motor");
  define("W1", d.coulomb_width, "rad/s, over which C1 changes its sign");
  define("J2", d.load_inertia, "kg m2, load");
  define("B2", d.load_viscous, "Nm s/rad, load");
  define("WEIGHT", d.load_mass * d.gravity * d.arm_length, "Nm, m g l of the load");
  text += fmt::format("#define OWN {}\n#define SIZE {}\n", rig.states, states);
  return text;
}

/// Functions of which the rest of the source uses any, in an order in which each stands above use.
std::string used(const std::vector<std::pair<std::string, std::string>>& functions,
                 const std::string& by) {
  std::string text;
  for (const auto& [name, function] : functions) {
    if (by.find(name + "(") != std::string::npos) text += function;
  }
  return text;
}

Result<std::vector<std::pair<std::string, std::string>>> laws_of(const ModelSpec& model) {
  std::vector<std::pair<std::string, std::string>> functions;
  for (const auto& [name, law] :
       {std::pair("law_f", &model.f), std::pair("law_g_inverse", &model.g_inverse),
        std::pair("law_h", &model.h)}) {
    auto text = c_law(*law, name);
    if (!text) return tl::unexpected(in_context(text.error(), name));
    functions.emplace_back(name, *text + "\n");
  }
  return functions;
}

Result<void> check_inertias(const RigModel& model) {
  const DriveSpec& d = model.drive;
  const bool motor = model.rig == Rig::free || model.rig == Rig::locked;
  const bool fine = (!motor || d.motor_inertia > 0.0) &&
                    (model.rig != Rig::free || d.load_inertia > 0.0) &&
                    (model.rig != Rig::servo || reflected_inertia(d) + d.load_inertia > 0.0);
  if (fine) return {};
  return failure(
      ErrorCode::bad_data,
      fmt::format("the model's [rig] lacks an inertia that the {} rig needs", name_of(model.rig)),
      "state motor_inertia and load_inertia in its table [rig], kg m2");
}

}  // namespace

std::string commented(const ExportHead& head, const std::string& prefix) {
  std::string text;
  for (const std::string& one : head.remarks) text += (text.empty() ? "" : "\n") + prefix + one;
  return text;
}

Result<Carried> carry_in_c(const RigModel& model) {
  if (auto good = check_inertias(model); !good) return tl::unexpected(good.error());
  Carrier carrier(model);
  carrier.drop_instruments();
  carrier.drop_effects(no_c_effect);
  return std::move(carrier).done();
}

Result<CModel> c_model(const RigModel& model, const ExportHead& head) {
  const CRigText& rig = text_of(model.rig);
  const auto effects = c_effects(model.drive.torsion);
  if (!effects) return tl::unexpected(effects.error());
  const auto laws = laws_of(model.drive.torsion);
  if (!laws) return tl::unexpected(laws.error());
  const std::size_t states = static_cast<std::size_t>(rig.states) + effects->memory;
  const bool load = model.rig == Rig::free;
  const bool moved = model.rig == Rig::specimen;
  const std::map<std::string, std::string> words = {
      {"name", head.name},
      {"NAME", upper(head.name)},
      {"head", commented(head, " * ")},
      {"states", std::to_string(states)},
      {"size", std::to_string(states)},
      {"state_names", fmt::format("{}{}", rig.state,
                                  effects->memory > 0 ? ", then the memory of the effects" : "")},
      {"input", std::string(rig.input)},
      {"load_equation", load ? std::string(kLoadEquation) : "  load = 0.0;\n  (void)load;\n"},
      {"load_rates", load ? "  dy[2] = x.load_speed;\n  dy[3] = load / J2;\n" : ""},
      {"feed_forward_declaration", filled(rig.feed_forward_says, {{"name", head.name}})}};
  std::string body =
      filled(rig.equations, words) + filled(moved ? kBetweenMotions : kBetweenTorques, words) +
      filled(kCStep, words) + filled(kReset, words) + filled(rig.feed_forward, words);
  std::string defines = constants(model.drive, rig, states);
  if (model.rig == Rig::free || model.rig == Rig::locked) {
    defines += load ? "#define LOAD_ANGLE y[2]\n#define LOAD_SPEED y[3]\n"
                    : "#define LOAD_ANGLE 0.0\n#define LOAD_SPEED 0.0\n";
  }
  CModel c;
  c.states = static_cast<int>(states);
  c.header = filled(kCHeader, words);
  c.source =
      fmt::format("#include \"{}.h\"\n\n#include <math.h>\n#include <string.h>\n\n", head.name) +
      defines + std::string(kInstant) + used(*laws, body) + used(effects->functions, body) + body;
  return c;
}

}  // namespace flexspline::data
