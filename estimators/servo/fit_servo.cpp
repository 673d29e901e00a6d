#include <algorithm>
#include <chrono>
#include <cmath>

#include <fmt/format.h>

#include "flexspline/estimators/ode_fit.hpp"
#include "flexspline/estimators/servo_fit.hpp"
#include "given_model/given_parameters.hpp"
#include "servo/servo_session.hpp"
#include "servo/servo_start.hpp"
#include "uncertainty/covariance.hpp"

namespace flexspline::estimators {
namespace {

constexpr double kMagnitude = 0.1;  // misfits beyond which an error costs its magnitude
constexpr double kSigma = 0.03;     // rad: a size of the misfit, its factor is estimated

/// The unknowns of a session and where each stands in the rig's parameter vector.
struct Unknowns {
  std::vector<OdeParameter> parameters;
  std::vector<std::vector<std::size_t>> targets;
};

std::vector<std::size_t> places(const std::vector<DriveParameter>& all,
                                std::initializer_list<std::string_view> names) {
  std::vector<std::size_t> list;
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (std::ranges::find(names, all[k].name) != names.end()) list.push_back(k);
  }
  return list;
}

void add_constant(Unknowns& unknowns, const std::vector<DriveParameter>& all,
                  std::initializer_list<std::string_view> names, double start) {
  const auto at = places(all, names);
  unknowns.parameters.push_back({.name = std::string(*names.begin()),
                                 .start = start,
                                 .lower = 1e-3 * start,
                                 .upper = 1e3 * start,
                                 .scale = start,
                                 .unit = all[at.front()].unit});
  unknowns.targets.push_back(at);
}

Unknowns unknowns_of(const DriveSpec& drive, const std::vector<DriveParameter>& all,
                     const std::vector<GivenParameter>& given) {
  Unknowns unknowns;
  add_constant(unknowns, all, {"torque_constant", "back_emf"}, drive.torque_constant);
  add_constant(unknowns, all, {"resistance"}, drive.resistance);
  add_constant(unknowns, all, {"motor_inertia"}, drive.motor_inertia);
  std::size_t laws = 0;
  for (const LawSpec* law : {&drive.torsion.f, &drive.torsion.g_inverse, &drive.torsion.h})
    laws += law->coefficients.size();
  // Effects come last in both lists.
  const std::size_t effects = given.size() - laws;
  for (std::size_t k = laws; k < given.size(); ++k) {
    const GivenParameter& one = given[k];
    if (one.held) continue;
    const double scale = one.start != 0.0 ? std::abs(one.start) : 1.0;
    unknowns.parameters.push_back({one.name, one.start, one.lower, one.upper, scale, one.unit});
    unknowns.targets.push_back({all.size() - effects + k - laws});
  }
  return unknowns;
}

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
  auto drive = servo_start(set, *recordings);
  if (!drive) return tl::unexpected(drive.error());
  drive->torsion = model.model;
  auto rig = make_rig(Rig::servo, *drive, clock->inputs, servo_form(settings.duty));
  if (!rig) return tl::unexpected(rig.error());
  const Unknowns unknowns = unknowns_of(*drive, (*rig)->parameter_list(), *given);
  const auto session = std::make_shared<ServoSession>(std::move(*rig), unknowns.targets);
  OdeFitProblem problem;
  problem.system = session;
  problem.parameters = unknowns.parameters;
  problem.state_scale.assign(session->states(), 1.0);
  for (std::size_t r = 0; r < recordings->size(); ++r) {
    problem.experiments.push_back(
        experiment_of(*(*recordings)[r], clock->start[r], session->states(), settings.every));
  }
  OdeFitSettings how{.integration_tolerance = settings.tolerance,
                     .max_iterations = settings.most_iterations};
  how.function_tolerance = 1e-5;
  if (settings.loss == ServoLoss::absolute) {
    how.loss = Loss::soft_l1;
    how.loss_scale = kMagnitude;
  }
  how.propose_recording = false;
  const auto fit = fit_ode(problem, OdeFitMethod::single_shooting, how);
  if (!fit) return tl::unexpected(fit.error());
  ServoFit result{estimate_of(*fit, problem), *drive};
  std::vector<double> p;
  for (const ParameterEstimate& one : fit->parameters) p.push_back(one.value);
  const auto values = session->whole<double>(p);
  result.drive = with_parameters(*drive, rig_row(Rig::servo).constants, values);
  result.estimate.model = result.drive.torsion;
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
