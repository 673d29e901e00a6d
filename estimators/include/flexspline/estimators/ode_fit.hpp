#pragma once

#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <Eigen/Core>

#include "flexspline/core/error.hpp"
#include "flexspline/core/estimate.hpp"
#include "flexspline/core/ode_system.hpp"

namespace flexspline::estimators {

/// Something to be estimated. Infinite bounds are no bounds.
struct OdeParameter {
  std::string name;
  double start = 0.0;
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  double scale = 1.0;  ///< typical size, > 0; the solvers work on parameter / scale
  std::string unit = "1";
};

/// A known initial value of a state, or one to be estimated.
using InitialValue = std::variant<double, OdeParameter>;

/// One record of a system from one initial state.
struct OdeExperiment {
  std::string id;
  double start_time = 0.0;              ///< at which the initial state holds
  std::vector<InitialValue> initial{};  ///< one a state
  std::vector<double> times{};          ///< of the measurements: increasing, not before start_time
  Eigen::MatrixXd observation{};        ///< outputs x states; empty: every state is an output
  std::vector<double> measured{};       ///< [instant][output]
  std::vector<double> sigma{};          ///< noise of each output, > 0; residuals are divided by it
  std::vector<bool> mask{};             ///< [instant][output], false: left out; empty: all count
};

/// y' = F(t, y; p) observed with noise. The same description serves every method.
struct OdeFitProblem {
  std::shared_ptr<const OdeSystem> system;  ///< a TwiceOdeSystem for collocation
  std::vector<OdeParameter> parameters;     ///< one a parameter of the system
  std::vector<OdeExperiment> experiments;
  std::vector<double> state_scale;  ///< typical size of each state; empty: from the measurements
};

/// single_shooting integrates from the initial state; multiple_shooting from states at nodes too,
/// joined by an augmented Lagrangian; collocation solves for the trajectory with the parameters.
/// The latter two start from the measurements where these show states.
enum class OdeFitMethod { single_shooting, multiple_shooting, collocation };

std::string_view name_of(OdeFitMethod method);

struct OdeFitSettings {
  double integration_tolerance = 1e-10;  ///< relative; absolute: times the state's scale
  int max_iterations = 200;              ///< of each solve
  int segments = 8;                      ///< at most, of an experiment in multiple shooting
  double mesh_tolerance = 1e-10;  ///< error of an element of collocation, relative to state_scale
  bool noise_known = false;       ///< sigma is the noise: normal intervals; else its factor is
                                  ///< estimated and intervals are Student's
};

struct OdeFit {
  OdeFitMethod method = OdeFitMethod::single_shooting;
  std::vector<ParameterEstimate> parameters{};  ///< the system's, then free initial values
  double cost = kNotComputed;                   ///< half the sum of squared weighted residuals
  Termination termination = Termination::not_run;
  int iterations = 0;
  long evaluations = 0;             ///< of residual blocks or of the NLP's constraints
  Eigen::MatrixXd covariance{};     ///< of parameters{}; zero rows for those on a bound
  std::vector<double> residuals{};  ///< experiment by experiment, [instant][output] without masked
  double degrees_of_freedom = kNotComputed;  ///< residuals less parameters, on a bound or not
  double noise_factor = kNotComputed;        ///< root of 2 cost / degrees of freedom
  double gap = 0.0;  ///< largest jump (shooting nodes) or defect (collocation), in state scales
  std::size_t elements = 0;          ///< segments or collocation elements, of all experiments
  std::vector<std::string> notes{};  ///< what a reader has to know before believing it
};

/// Fits a system to records by the method. Parameters on a bound keep no interval and leave the
/// covariance; their number still counts against the degrees of freedom.
/// Errors: bad_data (names, starts, bounds, times, measurements that do not fit the description),
/// usage (collocation of a system without second derivatives), numerics (the start cannot be
/// integrated, or the solver gives up).
Result<OdeFit> fit_ode(const OdeFitProblem& problem, OdeFitMethod method,
                       const OdeFitSettings& settings = {});

}  // namespace flexspline::estimators
