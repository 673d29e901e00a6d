#include "torsion/torsion_options.hpp"

namespace flexspline::estimators {

std::vector<OptionInfo> with_torsion_options(std::vector<OptionInfo> own) {
  const std::vector<OptionInfo> shared = {
      {.name = "h",
       .meaning = "auto: fitted where it is identifiable; unity: h = 1",
       .choices = {"auto", "unity"}},
      {.name = "inertia",
       .meaning = "an inertia torque that the sensor sees",
       .choices = {"auto", "off"}},
      {.name = "delay",
       .meaning = "a delay of the torque against the angle",
       .choices = {"auto", "off"}},
      {.name = "iterations",
       .meaning = "most iterations of the solver",
       .value = 60,
       .lower = 1,
       .upper = 10000},
      {.name = "samples",
       .meaning = "most residuals of one recording; longer ones are thinned evenly",
       .value = 3000,
       .lower = 100,
       .upper = 1e6},
      {.name = "uncertainty",
       .meaning = "where intervals of parameters come from; bands within the class follow the "
                  "bootstrap, else the covariance",
       .choices = {"covariance", "profile", "bootstrap_parametric", "bootstrap_block"}},
      {.name = "bands",
       .meaning = "of f, g^-1 and h: of a penalised mixed model of eq. (4), which counts what no "
                  "class follows (docs/fits.md); or within the fitted class",
       .choices = {"mixed_model", "class"}},
      {.name = "replicates",
       .meaning = "refits of the bootstrap",
       .value = 200,
       .lower = 20,
       .upper = 100000},
      {.name = "seed",
       .meaning = "of the bootstrap's random numbers",
       .value = 1,
       .lower = 0,
       .upper = 9e15}};
  own.insert(own.end(), shared.begin(), shared.end());
  return own;
}

StaticFitSettings static_settings(const FitProblem& problem, const MethodRow& method) {
  const auto whole = [&](const char* name) {
    return static_cast<std::size_t>(number(problem, method, name));
  };
  return {.samples = whole("samples"),
          .allowed = {.h = word(problem, method, "h") == "auto",
                      .inertia = word(problem, method, "inertia") == "auto",
                      .delay = word(problem, method, "delay") == "auto"},
          .solver = {.max_iterations = static_cast<int>(whole("iterations"))}};
}

UncertaintySettings uncertainty_settings(const FitProblem& problem, const MethodRow& method) {
  return {.kind = *find_uncertainty(word(problem, method, "uncertainty")),
          .replicates = static_cast<std::size_t>(number(problem, method, "replicates")),
          .seed = static_cast<std::uint64_t>(number(problem, method, "seed"))};
}

}  // namespace flexspline::estimators
