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
#include "flexspline/estimators/ode_inequalities.hpp"
#include "flexspline/estimators/uncertainty.hpp"

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
  std::shared_ptr<const OdeInequalities> inequalities{};  ///< none, or for collocation alone
};

/// single_shooting integrates from the initial state; multiple_shooting from states at nodes too,
/// joined by an augmented Lagrangian; collocation solves for the trajectory with the parameters.
/// The latter two start from the measurements where these show states.
enum class OdeFitMethod { single_shooting, multiple_shooting, collocation };

std::string_view name_of(OdeFitMethod method);

/// What a residual r in standard deviations costs, with c = loss_scale; as Ceres has them.
/// squared: r^2/2; huber: r^2/2 up to c, then c|r| - c^2/2; soft_l1: c^2 (sqrt(1 + r^2/c^2) - 1);
/// cauchy: c^2/2 ln(1 + r^2/c^2). All methods take all of them.
enum class Loss { squared, huber, soft_l1, cauchy };

std::string_view name_of(Loss loss);

/// How residuals are weighted. given: by the sigmas of the description. per_output: every output's
/// own noise is estimated from what it leaves, over again until it stays. coloured: every output's
/// noise is a first-order process beside white noise, estimated likewise, and its innovations are
/// minimised; with the squared loss alone.
enum class Weighting { given, per_output, coloured };

struct OdeFitSettings {
  double integration_tolerance = 1e-10;  ///< relative; absolute: times the state's scale
  long most_steps = 200000;              ///< of an integration; beyond, a trial point has failed
  int max_iterations = 200;              ///< of each solve
  int segments = 8;                      ///< at most, of an experiment in multiple shooting
  double mesh_tolerance = 1e-10;  ///< error of an element of collocation, relative to state_scale
  bool noise_known = false;       ///< sigma is the noise: normal intervals; else its factor is
                                  ///< estimated and intervals are Student's
  Loss loss = Loss::squared;
  double loss_scale = 1.345;  ///< in standard deviations of the noise, > 0
  Weighting weighting = Weighting::given;
  bool equation_error_start = true;  ///< collocation: parameters start where the smoothed outputs
                                     ///< satisfy the law best, where these show every state
  UncertaintySettings uncertainty{};
  double function_tolerance = 1e-13;  ///< shooting: relative fall of the cost that ends a solve
  bool propose_recording = true;      ///< where something is not told well: costs some simulations
};

/// The noise that one output was weighted with, over all experiments.
struct OutputNoise {
  double factor = 1.0;  ///< of its standard deviation, times the sigma of the description
  double share = 0.0;   ///< of its variance that is a first-order process; 0: white
  double time = 0.0;    ///< over which the correlation of that falls to 1/e
};

struct OdeFit {
  OdeFitMethod method = OdeFitMethod::single_shooting;
  std::vector<ParameterEstimate> parameters{};  ///< the system's, then free initial values
  double cost = kNotComputed;                   ///< half the sum of squared weighted residuals,
                                                ///< or what the loss makes of them
  Termination termination = Termination::not_run;
  int iterations = 0;
  long evaluations = 0;             ///< of residual blocks or of the NLP's constraints
  Eigen::MatrixXd covariance{};     ///< of parameters{}; zero rows for those on a bound
  std::vector<double> residuals{};  ///< weighted, experiment by experiment, [instant][output]
                                    ///< without masked; innovations where noise is coloured
  double degrees_of_freedom = kNotComputed;  ///< residuals less parameters that are free
  double noise_factor = kNotComputed;        ///< standard deviation of the residuals; with a robust
                                             ///< loss what it stands for in the covariance
  double gap = 0.0;  ///< largest jump (shooting nodes) or defect (collocation), in state scales
  std::size_t elements = 0;          ///< segments or collocation elements, of all experiments
  std::vector<std::string> notes{};  ///< what a reader has to know before believing it
  std::vector<OutputNoise> noise{};  ///< one an output
  Identifiability identifiability{};
  std::vector<std::string> active_inequalities{};  ///< by name
};

/// Fits a system to records by the method. Parameters on a bound keep no interval (but by profile
/// and bootstrap) and leave the covariance and the count of parameters; an active inequality takes
/// its direction out of both.
/// Errors: bad_data (names, starts, bounds, times, measurements that do not fit the description),
/// usage (what a method cannot do: collocation of a system without second derivatives,
/// shooting with inequalities), numerics (the start cannot be
/// integrated, or the solver gives up).
Result<OdeFit> fit_ode(const OdeFitProblem& problem, OdeFitMethod method,
                       const OdeFitSettings& settings = {});

}  // namespace flexspline::estimators
