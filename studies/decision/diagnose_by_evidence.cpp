#include <chrono>

#include <fmt/format.h>

#include "decision/account.hpp"
#include "diagnosis/experiment.hpp"
#include "diagnosis/search.hpp"
#include "diagnosis/specification.hpp"
#include "flexspline/core/in_parallel.hpp"
#include "flexspline/studies/decision.hpp"

namespace flexspline::studies {
namespace {

constexpr Eigen::Index kMostRows = 8000;
constexpr int kModelSteps = 8;
constexpr double kFewestRows = 300.0;

// Where it has been tried: a torsion that is wound up, measured and of one law.
Result<void> covered(const Frame& frame) {
  const bool wound_up = frame.rig == Rig::specimen && !frame.travels;
  if (frame.rig == Rig::locked || wound_up) return {};
  return failure(
      ErrorCode::usage,
      fmt::format("the engine 'evidence' does not cover {} yet",
                  frame.rig == Rig::specimen ? "an angle that travels"
                                             : fmt::format("the rig '{}'", name_of(frame.rig))),
      "leave --engine out, for the rules");
}

// What a model of an equation needs: rows, a motion and a torque.
Result<void> check(const Frame& frame) {
  const double rows = frame.usable.sum();
  if (rows < kFewestRows) {
    return failure(ErrorCode::bad_data,
                   fmt::format("{:.0f} samples are usable, fewer than {:.0f}", rows, kFewestRows),
                   "record longer, or more often");
  }
  if (!(frame.rate_range > 0.0)) {
    return failure(ErrorCode::bad_data, "nothing moves in the recordings",
                   "a diagnosis needs recordings in which the drive is moved");
  }
  for (const Equation equation : frame.equations) {
    if (frame.largest_torque(equation) > 0.0) continue;
    return failure(ErrorCode::bad_data,
                   fmt::format("the torque of the {} equation is 0 throughout", name_of(equation)),
                   "record the torque, or leave its channel out");
  }
  return {};
}

// The laws of a model file: those of the shipped estimator, with the causes that were named.
void add_model(const Frame& frame, const decision::DriveState& state, Diagnosis& to) {
  auto findings = fit_baseline(frame);
  if (!findings) return;
  for (const decision::Taken& cause : state.causes) {
    findings->fit.model.causes.push_back({cause.row, cause.form, cause.shape});
  }
  if (!fit_all(frame, *findings, kModelSteps)) return;
  auto specification = specify(frame, findings->fit.model);
  to.model = std::move(specification.model);
  to.notes.insert(to.notes.end(), specification.notes.begin(), specification.notes.end());
}

Result<Diagnosis> diagnosed(const RecordingSet& recordings, const DiagnosisProgress& progress,
                            const EvidenceSettings& settings) {
  if (progress) progress(0.0, "smoothing the motions");
  const auto frame = make_frame(recordings, kMostRows);
  if (!frame) return tl::unexpected(frame.error());
  const auto within = covered(*frame);
  if (!within) return tl::unexpected(within.error());
  const auto checked = check(*frame);
  if (!checked) return tl::unexpected(checked.error());
  decision::Calibration calibration;
  calibration.interest = settings.interest;
  const auto threads = static_cast<unsigned>(threads_for(settings.threads));
  const auto share = [&](double done, std::string_view stage) {
    if (progress) progress(0.5 * done, stage);
  };
  const decision::Decision d = decision::decide(*frame, calibration, threads, share);
  decision::Proof proof;
  proof.equation = frame->equations.front();
  if (settings.proves) {
    if (progress) progress(0.5, "the same in every outer fold");
    auto proved = decision::prove(recordings, *frame, d, calibration, threads);
    if (!proved) return tl::unexpected(proved.error());
    proof = std::move(*proved);
  }
  Diagnosis to;
  to.dataset = recordings.name;
  to.sha256 = recordings.sha256;
  to.display = recordings.display;
  to.notes = recordings.notes;
  to.notes.insert(to.notes.end(), frame->notes.begin(), frame->notes.end());
  to.baseline_model = "f, g and h as splines, f not odd by force; a zero of the angle";
  account(*frame, d, proof, calibration, to);
  if (one_loop(*frame)) {
    to.experiments = {another_rate(*frame)};
    to.next_experiment = to.experiments.front();
  }
  if (settings.model) add_model(*frame, d.fit.state, to);
  return to;
}

}  // namespace

Result<Diagnosis> diagnose_by_evidence(const RecordingSet& recordings,
                                       const DiagnosisProgress& progress,
                                       const EvidenceSettings& settings) {
  const auto start = std::chrono::steady_clock::now();
  auto result = diagnosed(recordings, progress, settings);
  if (!result) return result;
  result->seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (progress) progress(1.0, "done");
  return result;
}

}  // namespace flexspline::studies
