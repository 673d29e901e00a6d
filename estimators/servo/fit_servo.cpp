#include <algorithm>
#include <chrono>
#include <cmath>

#include <fmt/format.h>

#include "flexspline/estimators/given_parameters.hpp"
#include "flexspline/estimators/servo_fit.hpp"
#include "servo/servo_session.hpp"
#include "servo/servo_solve.hpp"
#include "servo/servo_start.hpp"
#include "servo/servo_unknowns.hpp"
#include "solvers/processor_share.hpp"
#include "uncertainty/covariance.hpp"

namespace flexspline::estimators {
namespace {

constexpr double kSigma = 0.03;  // rad: a size of the misfit, its factor is estimated
constexpr const char* kRodNote =
    "nothing measures a torque: the arm's mass is told by friction that grows with the load alone, "
    "and by nothing where the model has none";

double initial_speed(const Recording& recording) {
  if (const auto* speed = recording.find(Quantity::velocity)) return speed->front();
  return 0.0;
}

OdeExperiment experiment_of(const Recording& recording, double start, std::size_t states,
                            std::size_t every) {
  const auto& angle = *recording.find(Quantity::load_angle);
  OdeExperiment one;
  one.id = recording.id;
  one.start_time = start;
  one.sigma = {kSigma};
  one.initial.assign(states, 0.0);
  one.initial[0] = angle.front();
  one.initial[1] = initial_speed(recording);
  one.observation = Eigen::MatrixXd::Zero(1, static_cast<Eigen::Index>(states));
  one.observation(0, 0) = 1.0;
  for (std::size_t i = every; i < angle.size(); i += every) {
    one.times.push_back(start + recording.time[i] - recording.time.front());
    one.measured.push_back(angle[i]);
  }
  return one;
}

Result<std::vector<const Recording*>> training(const RecordingSet& set) {
  std::vector<const Recording*> list;
  for (const Recording& one : set.recordings) {
    if (one.split == Split::holdout) continue;
    if (one.find(Quantity::load_angle) == nullptr) {
      return failure(ErrorCode::input_missing,
                     fmt::format("recording {} has no load_angle to compare with", one.id),
                     "record it and name it in dataset.toml");
    }
    list.push_back(&one);
  }
  if (!list.empty()) return list;
  return failure(ErrorCode::bad_data, "there is no recording to train on",
                 "hold fewer of them out");
}

Estimate estimate_of(const OdeFit& fit, const OdeFitProblem& problem) {
  Estimate estimate;
  estimate.estimator = "servo_output_error";
  estimate.parameters = fit.parameters;
  const double wider = std::sqrt(std::max(1.0, long_run_ratio(fit.residuals)));
  for (ParameterEstimate& one : estimate.parameters) {
    one.ci95_lower = one.value - wider * (one.value - one.ci95_lower);
    one.ci95_upper = one.value + wider * (one.ci95_upper - one.value);
    one.std *= wider;
  }
  estimate.notes = fit.notes;
  estimate.notes.push_back(
      fmt::format("standard deviations are {:.3g} times those of independent residuals", wider));
  estimate.termination = fit.termination;
  estimate.cost = fit.cost;
  estimate.residual =
      fmt::format("angle simulated from the first sample on, in units of {} rad", kSigma);
  std::size_t next = 0;
  for (const OdeExperiment& one : problem.experiments) {
    double sum = 0.0;
    for (std::size_t i = 0; i < one.times.size(); ++i, ++next)
      sum += fit.residuals[next] * fit.residuals[next];
    estimate.fits.push_back(
        {one.id, Split::train, kSigma * std::sqrt(sum / static_cast<double>(one.times.size()))});
  }
  estimate.identifiability = fit.identifiability;
  estimate.evaluations = fit.evaluations;
  return estimate;
}

OdeFitProblem problem_of(std::shared_ptr<const ServoSession> session, const ServoUnknowns& unknowns,
                         const std::vector<const Recording*>& recordings, const ServoClock& clock,
                         const ServoSettings& settings) {
  OdeFitProblem problem;
  problem.parameters = unknowns.parameters;
  problem.state_scale.assign(session->states(), 1.0);
  for (std::size_t r = 0; r < recordings.size(); ++r) {
    problem.experiments.push_back(
        experiment_of(*recordings[r], clock.start[r], session->states(), settings.every));
  }
  problem.system = std::move(session);
  return problem;
}

/// The problem as often as threads may work at it: a system serves one thread.
Result<std::vector<OdeFitProblem>> problems_of(const DriveSpec& drive,
                                               const std::vector<const Recording*>& recordings,
                                               const ServoClock& clock,
                                               const std::vector<GivenParameter>& given,
                                               const ServoSettings& settings) {
  const ProcessorShare share(0);
  std::vector<OdeFitProblem> problems;
  for (std::size_t k = 0; k < (settings.searches > 0 ? share.threads() : 1); ++k) {
    auto rig = make_rig(Rig::servo, drive, clock.inputs, servo_form(settings.duty));
    if (!rig) return tl::unexpected(rig.error());
    auto unknowns = servo_unknowns(drive, (*rig)->parameter_list(), given, settings);
    if (auto told = start_at(settings.start, unknowns); !told) return tl::unexpected(told.error());
    auto session = std::make_shared<ServoSession>(std::move(*rig), unknowns.targets);
    problems.push_back(problem_of(std::move(session), unknowns, recordings, clock, settings));
  }
  return problems;
}

/// The weight is of the drive, not of the model that was given.
ServoFit result_of(const OdeFit& fit, const OdeFitProblem& problem, const DriveSpec& drive,
                   const ServoSettings& settings) {
  ServoFit result{estimate_of(fit, problem), drive};
  std::vector<double> p;
  for (const ParameterEstimate& one : fit.parameters) p.push_back(one.value);
  const auto& session = dynamic_cast<const ServoSession&>(*problem.system);
  const auto values = session.whole<double>(p);
  result.drive = with_parameters(drive, rig_row(Rig::servo).constants, values);
  result.estimate.model = result.drive.torsion;
  result.estimate.model.effects.pop_back();
  if (settings.arm == ServoArm::rod) result.estimate.notes.push_back(kRodNote);
  return result;
}

}  // namespace

Result<ServoFit> fit_servo(const RecordingSet& set, const GivenModel& model,
                           const ServoSettings& settings) {
  const auto started = std::chrono::steady_clock::now();
  const auto recordings = training(set);
  if (!recordings) return tl::unexpected(recordings.error());
  const auto given = given_parameters(model);
  if (!given) return tl::unexpected(given.error());
  const auto clock = servo_clock(*recordings, settings.duty);
  if (!clock) return tl::unexpected(clock.error());
  auto known = servo_start(set, *recordings);
  if (!known) return tl::unexpected(known.error());
  known->torsion = model.model;
  const DriveSpec drive = with_weight_as_effect(*known);
  const auto problems = problems_of(drive, *recordings, *clock, *given, settings);
  if (!problems) return tl::unexpected(problems.error());
  const auto fit = solve_servo(*problems, settings);
  if (!fit) return tl::unexpected(fit.error());
  ServoFit result = result_of(*fit, problems->front(), drive, settings);
  result.estimate.seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  return result;
}

Result<std::vector<double>> simulate_servo(const DriveSpec& drive, const Recording& recording,
                                           double tolerance, ServoDuty duty) {
  const auto clock = servo_clock({&recording}, duty);
  if (!clock) return tl::unexpected(clock.error());
  const auto rig = make_rig(Rig::servo, drive, clock->inputs, servo_form(duty));
  if (!rig) return tl::unexpected(rig.error());
  std::vector<double> initial = (*rig)->rest();
  initial[0] = recording.find(Quantity::load_angle)->front();
  initial[1] = initial_speed(recording);
  std::vector<double> times = recording.time;
  for (double& t : times) t -= recording.time.front();
  const auto run = integrate_system(**rig, (*rig)->parameter_vector(), times, initial,
                                    {.relative_tolerance = tolerance, .absolute_tolerance = {}});
  if (!run) return tl::unexpected(in_context(run.error(), "recording " + recording.id));
  std::vector<double> angle;
  for (std::size_t i = 0; i < times.size(); ++i) angle.push_back(run->state[i * run->states]);
  return angle;
}

}  // namespace flexspline::estimators
