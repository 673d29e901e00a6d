#include "export/c_effects.hpp"

#include <fmt/format.h>

#include "export/c_expression.hpp"
#include "flexspline/core/effect_dependence.hpp"
#include "flexspline/core/effect_path.hpp"

namespace flexspline::data {
namespace {

using TracedInstant = Instant<Traced>;

constexpr std::pair<std::string_view, Traced TracedInstant::*> kFields[] = {
    {"time", &TracedInstant::time},
    {"motor_angle", &TracedInstant::motor_angle},
    {"motor_speed", &TracedInstant::motor_speed},
    {"load_angle", &TracedInstant::load_angle},
    {"load_speed", &TracedInstant::load_speed},
    {"torsion", &TracedInstant::torsion},
    {"torsion_rate", &TracedInstant::torsion_rate},
    {"transmitted_torque", &TracedInstant::transmitted_torque},
    {"motor_torque", &TracedInstant::motor_torque},
    {"motor_torque_rate", &TracedInstant::motor_torque_rate},
    {"gear_ratio", &TracedInstant::gear_ratio}};

TracedInstant traced_instant() {
  TracedInstant x;
  for (const auto& [name, member] : kFields) {
    x.*member = Traced::variable(fmt::format("x->{}", name));
  }
  return x;
}

/// An effect with its traced parameters and memory.
struct Use {
  const EffectRow* row;
  Site site;
  bool across;
  std::vector<Traced> parameters;
  std::size_t state;
  std::size_t states;

  std::vector<Traced> memory() const {
    std::vector<Traced> z;
    for (std::size_t k = 0; k < states; ++k) {
      z.push_back(Traced::variable(fmt::format("z[{}]", state + k)));
    }
    return z;
  }
  TracedInstant seen(const TracedInstant& x) const { return across ? across_transmission(x) : x; }
  Traced term(const TracedInstant& x) const {
    return row->traced.term(seen(x), parameters, memory());
  }
};

Result<std::vector<Use>> uses_of(const ModelSpec& model) {
  std::vector<Use> uses;
  std::size_t state = 0;
  for (const EffectSpec& effect : model.effects) {
    const auto row = find_effect(effect.effect);
    if (!row) return tl::unexpected(row.error());
    const auto values = parameter_values(**row, effect);
    if (!values) return tl::unexpected(values.error());
    const std::size_t states = state_count(**row, values->size());
    uses.push_back({*row,
                    site_of(**row, effect),
                    effect.across,
                    {values->begin(), values->end()},
                    state,
                    states});
    state += states;
  }
  return uses;
}

constexpr std::pair<std::string_view, Site> kSums[] = {{"at_motor", Site::motor},
                                                       {"at_load", Site::load},
                                                       {"at_transmission", Site::transmission},
                                                       {"kinematics", Site::kinematics}};
constexpr std::pair<std::string_view, Site> kSlopes[] = {{"kinematics", Site::kinematics},
                                                         {"transmission", Site::transmission}};

constexpr const char* kArguments = "(const instant *x, const double *z)";
constexpr const char* kUnused = "  (void)x;\n  (void)z;\n";

Traced sum_at(Site site, const std::vector<Use>& uses, const TracedInstant& x) {
  Traced sum(0.0);
  for (const Use& use : uses) {
    if (use.site == site) sum += use.term(x);
  }
  return sum;
}

std::string sum_function(std::string_view name, Site site, const std::vector<Use>& uses) {
  const Traced::Tape tape;
  const Traced sum = sum_at(site, uses, traced_instant());
  return fmt::format("static double {}{} {{\n{}{}}}\n\n", name, kArguments, kUnused,
                     c_return(tape, sum));
}

std::string slope_function(std::string_view name, Site site, std::string_view over,
                           const std::vector<Use>& uses) {
  Traced::Tape tape;
  const Traced sum = sum_at(site, uses, traced_instant());
  const Traced slope = derivative(tape, sum, fmt::format("x->{}", over));
  return fmt::format("static double {}{} {{\n{}{}}}\n\n", name, kArguments, kUnused,
                     c_return(tape, slope));
}

// Along the motion: the chain rule over time, angles, torsion and memory.
std::string kinematics_rate(const std::vector<Use>& uses) {
  Traced::Tape tape;
  const TracedInstant x = traced_instant();
  const Traced sum = sum_at(Site::kinematics, uses, x);
  Traced rate = derivative(tape, sum, "x->time");
  rate += derivative(tape, sum, "x->motor_angle") * x.motor_speed;
  rate += derivative(tape, sum, "x->load_angle") * x.load_speed;
  rate += derivative(tape, sum, "x->torsion") * x.torsion_rate;
  return fmt::format("static double kinematics_rate{} {{\n{}{}}}\n\n", kArguments, kUnused,
                     c_return(tape, rate));
}

std::string memory_rates(const std::vector<Use>& uses) {
  const Traced::Tape tape;
  const TracedInstant x = traced_instant();
  std::vector<Traced> rates;
  for (const Use& use : uses) {
    if (use.states == 0) continue;
    std::vector<Traced> own(use.states);
    use.row->traced.rate(use.seen(x), use.parameters, use.memory(), own);
    rates.insert(rates.end(), own.begin(), own.end());
  }
  return "static void memory_rates(const instant *x, const double *z, double *dz) {\n" +
         std::string(kUnused) + "  (void)dz;\n" + c_assign(tape, rates, "dz") + "}\n\n";
}

bool needs(const EffectRow& row, const std::vector<double>& values,
           std::initializer_list<Complex Instant<Complex>::*> members) {
  for (auto member : members) {
    if (depends_on(row, values, member)) return true;
  }
  return false;
}

}  // namespace

std::string no_c_effect(const EffectRow& row, const EffectSpec& effect) {
  using I = Instant<Complex>;
  if (row.map != nullptr || row.traced.term == nullptr) return "it acts on a whole signal";
  const auto values = parameter_values(row, effect);
  if (!values) return values.error().message();
  if (row.states > 0 && row.traced.rate == nullptr) return "its memory goes from sample to sample";
  if (needs(row, *values,
            {&I::motor_acceleration, &I::load_acceleration, &I::torsion_acceleration,
             &I::transmitted_torque_rate})) {
    return "it needs an acceleration, which is a result";
  }
  if (row.site != Site::kinematics) return {};
  return row.states > 0 ||
                 needs(row, *values,
                       {&I::transmitted_torque, &I::torsion_rate, &I::motor_speed, &I::load_speed})
             ? "it is a give in series with the torsion law, whose torque is then implicit"
             : "";
}

Result<CEffects> c_effects(const ModelSpec& model) {
  const auto uses = uses_of(model);
  if (!uses) return tl::unexpected(uses.error());
  CEffects effects;
  for (const Use& use : *uses) effects.memory += use.states;
  const auto add = [&](const std::string& name, std::string text) {
    effects.functions.emplace_back(name, std::move(text));
  };
  for (const auto& [name, site] : kSums) add(std::string(name), sum_function(name, site, *uses));
  add("kinematics_rate", kinematics_rate(*uses));
  for (const char* shaft : {"motor", "load"}) {
    for (const auto& [name, site] : kSlopes) {
      const std::string function = fmt::format("{}_by_{}", name, shaft);
      add(function, slope_function(function, site, fmt::format("{}_angle", shaft), *uses));
    }
  }
  add("memory_rates", memory_rates(*uses));
  return effects;
}

}  // namespace flexspline::data
