#include "torsion/static_fit.hpp"

#include <cmath>

#include <fmt/format.h>

#include "torsion/both_ways.hpp"

namespace flexspline::estimators {
namespace {

constexpr std::size_t kRememberedBytes = std::size_t{8} << 20U;
constexpr double kMisses = 1.5;  // residual over noise from which a model misses something

// f need not pass the origin of a joint that travels, and a specimen's zero is where it was
// clamped.
FreeTerms base_terms(const std::vector<PreparedRecord>& records) {
  FreeTerms base;
  const bool travels = records.front().record.travels;
  const double range = ranges_of(records, true).motion;
  for (const auto& one : records) {
    if (!travels && std::abs(centre_of(one)) > 0.05 * range) base.zeros = true;
  }
  base.offset = !travels;
  return base;
}

std::string misfit_note(const Leftover& left) {
  return fmt::format(
      "eq. (4) with these laws leaves {:.3g} times the noise of the recordings: "
      "physics is missing from the model",
      left.residual / left.noise);
}

Result<void> enough_samples(const std::vector<PreparedRecord>& records, std::size_t unknowns) {
  std::size_t rows = 0;
  for (const auto& one : records) rows += one.rows.size();
  if (rows > unknowns) return {};
  return failure(ErrorCode::bad_data,
                 fmt::format("{} valid samples for {} unknowns", rows, unknowns),
                 "record longer, or denser");
}

// The class of f and g^-1 and the fit of eq. (4) with the terms that are free.
Result<TrajectoryFit> fitted(const std::vector<PreparedRecord>& records, FreeTerms base,
                             const LinearStart& richest, FreeTerms free,
                             const StaticFitSettings& settings) {
  const auto start = settings.intervals > 0 ? even_start(records, base, settings.intervals)
                                            : chosen_start(records, base, richest, free);
  if (!start) return tl::unexpected(start.error());
  const LinearStart all = with_terms(*start, free);
  if (auto enough = enough_samples(records, all.layout.size()); !enough) {
    return tl::unexpected(enough.error());
  }
  return fit_torque(all, records, settings.solver);
}

Result<StaticFit> made(const std::vector<TorsionRecord>& records, const StaticFitSettings& settings,
                       const Content& content) {
  if (records.empty()) {
    return failure(ErrorCode::bad_data, "there is no recording to train on",
                   "mark one with split = \"train\"");
  }
  auto prepared = prepare(records, settings.samples);
  if (!prepared) return tl::unexpected(prepared.error());
  if (auto both = passed_both_ways(*prepared); !both) return tl::unexpected(both.error());
  const bool travels = prepared->front().record.travels;
  const AllowedTerms allowed{.h = !travels && settings.allowed.h,
                             .inertia = !travels && settings.allowed.inertia,
                             .delay = settings.allowed.delay};
  const FreeTerms base = base_terms(*prepared);
  const auto richest = richest_start(*prepared, base);
  if (!richest) return tl::unexpected(richest.error());
  if (auto added = add_motion_noise(*prepared, *richest); !added) {
    return tl::unexpected(added.error());
  }
  auto decision = decide_terms(*richest, *prepared, base, allowed);
  if (!decision) return tl::unexpected(decision.error());
  if (travels) decision->says = "h = 1: over a motion that travels it would be a second f";

  auto fit = fitted(*prepared, base, *richest, decision->free, settings);
  if (!fit) return tl::unexpected(fit.error());
  const Leftover left = leftover(*fit, *prepared);
  const bool misses = left.residual > kMisses * left.noise;
  if (misses) {
    decision->notes.push_back(misfit_note(left));
    add_misfit(*prepared, left);
    fit = fitted(*prepared, base, *richest, decision->free, settings);
    if (!fit) return tl::unexpected(fit.error());
  }
  if (!fit->refused.empty()) decision->notes.push_back(fit->refused);
  return StaticFit{std::move(*prepared), std::move(*decision), std::move(*fit), content, misses};
}

// Names stand in messages and models, so that they count, too.
Content content_of(const std::vector<TorsionRecord>& records, const StaticFitSettings& settings) {
  const SolverSettings& solver = settings.solver;
  const AllowedTerms& allowed = settings.allowed;
  Content all{{static_cast<double>(settings.samples), static_cast<double>(settings.intervals),
               allowed.h ? 1.0 : 0.0, allowed.inertia ? 1.0 : 0.0, allowed.delay ? 1.0 : 0.0,
               static_cast<double>(solver.max_iterations), solver.function_tolerance,
               solver.parameter_tolerance, solver.gradient_tolerance, solver.trust_radius,
               solver.damping_floor}};
  for (const auto& record : records) {
    all.add(flexspline::content_of(record).numbers);
    all.add(std::vector<double>(record.id.begin(), record.id.end()));
    all.add(std::vector<double>(record.valid.begin(), record.valid.end()));
    all.numbers.insert(all.numbers.end(),
                       {record.linear ? 1.0 : 0.0, record.amplitude.value_or(kNotComputed)});
  }
  return all;
}

}  // namespace

Result<StaticFit> fit_static(const std::vector<TorsionRecord>& records,
                             const StaticFitSettings& settings) {
  static Remembered<Result<StaticFit>> remembered(kRememberedBytes);
  const Content content = content_of(records, settings);
  return *remembered.of(content, [&] { return made(records, settings, content); });
}

}  // namespace flexspline::estimators
