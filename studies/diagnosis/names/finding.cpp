#include "diagnosis/names/finding.hpp"

#include <optional>

#include <fmt/format.h>

#include "diagnosis/frame/accelerations.hpp"
#include "diagnosis/names/confirm.hpp"
#include "diagnosis/names/part_of_progress.hpp"
#include "diagnosis/names/unnamed_causes.hpp"
#include "diagnosis/next/experiment.hpp"
#include "diagnosis/search/bandwidths.hpp"
#include "diagnosis/search/incident.hpp"
#include "diagnosis/search/zeros.hpp"

namespace flexspline::studies {
namespace {

using Progress = std::function<void(double, std::string_view)>;

// One loop proves no cause: there is nothing to hold it against.
Result<void> leave_out_unproved(const Frame& frame, Selection& selection) {
  while (one_loop(frame) && !selection.accepted.empty()) {
    const auto left_out =
        leave_out(frame, selection, selection.accepted.size() - 1, "one loop cannot prove it");
    if (!left_out) return left_out;
  }
  return {};
}

// The model of another selection, or of a first one, on this frame.
Result<Findings> first_model(const Frame& frame, const Limits& limits, const Progress& progress,
                             const Selection* from) {
  if (from == nullptr) return nearest_model(frame, limits, progress);
  Findings model = from->final;
  return refresh(frame, model, kRefreshSteps).map([&] { return std::move(model); });
}

// With every recording counted from where the causes fit it best.
Result<Selection> aligned(Frame& frame, const Limits& limits, const Progress& progress,
                          const Selection* from) {
  if (!frame.own_zeros) return select_causes(frame, limits, progress, from);
  const auto model = first_model(frame, limits, progress, from);
  if (!model) return tl::unexpected(model.error());
  auto moved = with_fitted_zeros(frame, *model);
  if (!moved) return tl::unexpected(moved.error());
  frame = std::move(*moved);
  return select_causes(frame, limits, progress);
}

std::optional<Incident> next_incident(const Frame& frame, const Selection& selection,
                                      const Limits& limits) {
  if (frame.incidents.size() >= limits.incidents) return std::nullopt;
  return find_incident(frame, selection.final, limits);
}

// Again without a stretch of one recording that has something of its own, until none has.
Result<Selection> beside_incidents(Frame& frame, const Limits& limits, const Progress& progress,
                                   const Selection* from) {
  auto selection = aligned(frame, limits, progress, from);
  while (selection) {
    const auto incident = next_incident(frame, *selection, limits);
    if (!incident) break;
    frame = without_incident(std::move(frame), *incident);
    selection = aligned(frame, limits, progress, nullptr);
  }
  return selection;
}

Result<Finding> confirmed(Frame frame, const Limits& limits, const Progress& progress,
                          Selection selection) {
  if (progress) progress(0.75, "proving on recordings held out");
  const auto settled = settle_baseline(frame, selection);
  if (!settled) return tl::unexpected(settled.error());
  const auto proved = leave_out_unproved(frame, selection);
  if (!proved) return tl::unexpected(proved.error());
  auto proof = confirm(frame, limits, selection);
  if (!proof) return tl::unexpected(proof.error());
  return Finding{std::move(frame), std::move(selection), std::move(*proof)};
}

// With a firm spring, where that leaves a gap. One that is known without needs no stretch left out
// to be wider: what a model cannot follow it does not predict as well.
Result<std::optional<Finding>> with_gap(const Finding& free_f, const Limits& limits,
                                        const Progress& progress) {
  const bool known = has_a_gap(free_f.selection);
  Frame frame = with_firm_spring(free_f.frame);
  auto selection = known ? aligned(frame, limits, progress, &free_f.selection)
                         : beside_incidents(frame, limits, progress, &free_f.selection);
  if (!selection) return tl::unexpected(selection.error());
  if (known && next_incident(frame, *selection, limits)) return std::nullopt;
  if (!has_a_gap(*selection)) return std::nullopt;
  return confirmed(std::move(frame), limits, progress, std::move(*selection))
      .map([](Finding&& finding) { return std::optional(std::move(finding)); });
}

std::string gap_in_words(const Finding& free_f, const Finding& gap) {
  const HoldoutProof& h = free_f.proof.holdout;
  return fmt::format(
      "a free f would be flat in its middle ({:.2g} of the mean slope); a firm one with a gap "
      "predicts the recordings held out as well: {:.3g} Nm against {:.3g} (95 %: to {:.3g})",
      softness(free_f.frame, free_f.selection), gap.proof.holdout.rmse_after, h.rmse_after,
      h.ci95_upper * h.rmse_before);
}

// With accelerations of the bandwidths that the frame has.
Result<Finding> found_in(Frame frame, const Limits& limits, const Progress& progress) {
  auto selection = beside_incidents(frame, limits, progress, nullptr);
  if (!selection) return tl::unexpected(selection.error());
  auto free_f = confirmed(std::move(frame), limits, progress, std::move(*selection));
  if (!free_f || !may_hide_a_gap(free_f->frame, free_f->selection, limits)) return free_f;
  auto gap = with_gap(*free_f, limits, progress);
  if (!gap) return tl::unexpected(gap.error());
  if (!*gap || !tells_a_gap((*gap)->selection, free_f->proof, (*gap)->proof, limits)) return free_f;
  (*gap)->frame.notes.push_back(gap_in_words(*free_f, **gap));
  return std::move(**gap);
}

}  // namespace

Result<Finding> find_causes(Frame frame, const Limits& limits, const Progress& progress) {
  if (!frame.accelerations) return found_in(std::move(frame), limits, progress);
  auto found = found_in(frame, limits, part_of(progress, 0.0, 0.5));
  if (!found) return found;
  const auto bandwidths = best_bandwidths(found->frame, found->selection.final);
  if (bandwidths == bandwidths_of(frame)) return found;
  frame = with_bandwidths(std::move(frame), bandwidths);
  frame.notes.push_back(bandwidths_in_words(frame));
  auto again = found_in(std::move(frame), limits, part_of(progress, 0.5, 1.0));
  if (!again) {
    found->frame.notes.push_back(
        fmt::format("with accelerations of narrower bandwidths nothing could be searched: {}",
                    again.error().message()));
    return found;
  }
  // What it takes of a ripple, a narrower bandwidth hides.
  const bool better = again->proof.holdout.rmse_after < found->proof.holdout.rmse_after;
  return better ? std::move(again) : std::move(found);
}

Result<Finding> with_probable_names(Finding finding, const Limits& limits) {
  auto proof =
      take_improbable_names(finding.frame, limits, finding.selection, std::move(finding.proof));
  if (!proof) return tl::unexpected(proof.error());
  finding.proof = std::move(*proof);
  return finding;
}

}  // namespace flexspline::studies
