#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "answers/kind_tables.hpp"
#include "answers/profile_answer.hpp"
#include "flexspline/core/nearest_name.hpp"
#include "flexspline/estimators/given_parameters.hpp"
#include "flexspline/studies/kind.hpp"

namespace flexspline::studies {
namespace {

using estimators::GivenParameter;

constexpr std::size_t kMostFits = 2000;
constexpr double kWidest = 6.0;  // standard deviations; a parabola crosses 3.84 at 1.96

/// Numbers, from 1, of the fitted parameters that are to be profiled; all where none is named.
std::vector<std::size_t> chosen(TomlSection& own, const std::vector<GivenParameter>& all,
                                const std::vector<std::string>& only) {
  std::vector<std::size_t> numbers;
  std::vector<std::string_view> names;
  for (const GivenParameter& one : all) {
    if (one.held) continue;
    names.emplace_back(one.name);
    const bool named = only.empty() || std::ranges::find(only, one.name) != only.end();
    if (named) numbers.push_back(names.size());
  }
  for (const std::string& name : only) {
    if (std::ranges::find(names, name) != names.end()) continue;
    own.refuse("parameters", fmt::format("no parameter '{}' is fitted", name),
               suggestion(name, names));
  }
  return numbers;
}

/// Every estimator that fits a model file, free, and with each parameter held at points on both
/// sides of its estimate.
void read(TomlSection& own, StudyConfig& study) {
  const auto points = own.integer("points", 1, 100).value_or(6);
  const double widest = own.has("widest") ? own.number("widest").value_or(kWidest) : kWidest;
  if (!(widest > 0.0)) own.refuse("widest", "no distance", "write a positive number, widest = 6");
  const std::vector<std::string> only = own.texts("parameters");
  std::vector<EstimatorConfig> made;
  for (const EstimatorConfig& written : study.estimators) {
    if (!written.model) {
      own.refuse("",
                 fmt::format("estimator '{}' fits no model file, so it has no parameters to hold",
                             written.id),
                 "use method = \"model_file\" with model = \"…\"");
      continue;
    }
    const auto parameters = given_parameters(*written.model);
    if (!parameters) {
      own.refuse("", parameters.error().problem, parameters.error().remedy);
      continue;
    }
    made.push_back(made_from(written, std::string(kFreeFit)));
    for (const std::size_t number : chosen(own, *parameters, only)) {
      for (std::int64_t k = -points; k <= points; ++k) {
        if (k == 0) continue;
        const double distance = widest * static_cast<double>(k) / static_cast<double>(points);
        EstimatorConfig& one =
            made.emplace_back(made_from(written, fmt::format("p{}-{}", number, k + points)));
        one.options.numbers["profile_parameter"] = static_cast<double>(number);
        one.options.numbers["profile_distance"] = distance;
      }
    }
  }
  if (made.size() > kMostFits) {
    own.refuse("points",
               fmt::format("that makes {} fits, where {} are the most", made.size(), kMostFits),
               "name fewer parameters");
  }
  if (!made.empty()) study.estimators = std::move(made);
}

}  // namespace

KindRow describe_profile() {
  return {.id = "profile",
          .summary = "a model file fitted with each parameter held about its estimate",
          .cases = "inputs x estimators with a model x (1 + parameters x points) x replicates",
          .question = "Which parameters do the recordings bound?",
          .read = read,
          .answer = answer_profiles};
}

}  // namespace flexspline::studies
