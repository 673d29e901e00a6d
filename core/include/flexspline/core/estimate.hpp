#pragma once

#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "flexspline/core/model_spec.hpp"
#include "flexspline/core/recording.hpp"

namespace flexspline {

inline constexpr double kNotComputed = std::numeric_limits<double>::quiet_NaN();

/// How an estimation ended. Starts at not_run, so that what never ran cannot look like a result.
enum class Termination { not_run, converged, iteration_limit, no_progress, failed };

std::string_view name_of(Termination termination);

struct ParameterEstimate {
  std::string name;
  double value = kNotComputed;
  double std = kNotComputed;
  double ci95_lower = kNotComputed;
  double ci95_upper = kNotComputed;
  std::string unit;
  bool bound_active = false;
};

/// How much of a parameter (or function) the rest of the model can imitate on these recordings.
struct Absorbed {
  std::string parameter;
  std::string by;
  double cosine = kNotComputed;  ///< of the angle to the nearest direction of the rest
};

struct Identifiability {
  double condition = kNotComputed;  ///< of the column-scaled Jacobian
  std::vector<Absorbed> absorbed;
  std::string verdict =
      "not_computed";  ///< identifiable | weak | not_identifiable | not_asked | not_computed
  std::string says;    ///< the verdict in a sentence, with its reason
};

/// One estimated function with its pointwise 95 % band.
struct FunctionBand {
  std::string function;  ///< f | g_inverse | h
  std::vector<double> argument{};
  std::vector<double> value{};
  std::vector<double> lower{};
  std::vector<double> upper{};
  double valid_from = kNotComputed;  ///< the domain the recordings support
  double valid_to = kNotComputed;
};

struct RecordingFit {
  std::string id;
  Split split = Split::train;
  double rmse = kNotComputed;  ///< in the unit of the residual that was minimised
};

/// What a method gives back.
struct Estimate {
  std::string estimator;
  ModelSpec model;
  std::vector<ParameterEstimate> parameters;
  Termination termination = Termination::not_run;
  double cost = kNotComputed;  ///< half the sum of squared weighted residuals
  std::string residual;        ///< what was minimised, in words with its unit
  std::vector<RecordingFit> fits;
  Identifiability identifiability;
  std::vector<FunctionBand> bands;
  std::vector<std::string> notes;  ///< what a reader has to know before believing it
  double seconds = kNotComputed;
  long evaluations = 0;
};

}  // namespace flexspline
