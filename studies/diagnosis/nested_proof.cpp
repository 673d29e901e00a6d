#include "diagnosis/nested_proof.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "diagnosis/folds.hpp"
#include "diagnosis/spelled.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

// Of a fold: its share of all, and which it is.
DiagnosisProgress progress_of(const DiagnosisProgress& progress, std::size_t fold,
                              std::size_t folds) {
  if (!progress) return {};
  return [&progress, fold, folds](double share, std::string_view stage) {
    progress((static_cast<double>(fold) + share) / static_cast<double>(folds),
             fmt::format("without fold {} of {}: {}", fold + 1, folds, stage));
  };
}

struct SearchedFold {
  Judged judged;
  std::vector<std::string> named;
};

Result<SearchedFold> search_without(const RecordingSet& all, const Frame& whole,
                                    const ArrayXd& fold, Equation equation, const Limits& limits,
                                    Index most_rows, const DiagnosisProgress& progress) {
  auto frame = make_frame(without_rows(all, whole, fold), most_rows);
  if (!frame) return tl::unexpected(frame.error());
  const auto finding = find_causes(std::move(*frame), limits, progress);
  if (!finding) return tl::unexpected(finding.error());
  SearchedFold searched;
  for (const Cause& cause : spelled_causes(finding->frame, finding->selection, finding->proof)) {
    searched.named.push_back(cause.effect);
    searched.named.insert(searched.named.end(), cause.alternatives.begin(),
                          cause.alternatives.end());
  }
  auto judged = judge(whole, fold, *finding, equation);
  if (!judged) return tl::unexpected(judged.error());
  searched.judged = std::move(*judged);
  return searched;
}

}  // namespace

Result<NestedProof> nested_proof(const RecordingSet& all, const Finding& finding,
                                 const Limits& limits, Index most_rows,
                                 const DiagnosisProgress& progress) {
  const auto whole = make_frame(all, most_rows);
  if (!whole) return tl::unexpected(whole.error());
  const Equation equation = equation_to_prove(finding.frame, finding.selection);
  const auto folds = outer_folds(*whole);
  NestedProof nested;
  ArrayXd held = ArrayXd::Zero(whole->rows());
  ArrayXd before = held, after = held;
  for (std::size_t k = 0; k < folds.size(); ++k) {
    const auto one = search_without(all, *whole, folds[k], equation, limits, most_rows,
                                    progress_of(progress, k, folds.size()));
    if (!one) return tl::unexpected(one.error());
    nested.named.push_back(one->named);
    held += one->judged.held;
    before += one->judged.residual_before * one->judged.held;
    after += one->judged.residual_after * one->judged.held;
  }
  nested.proof = proof_on(*whole, held, equation, before, after);
  nested.proof.folds = static_cast<int>(folds.size());
  return nested;
}

double stability_of(const NestedProof& nested, const Cause& cause) {
  const auto is_named = [&](const std::vector<std::string>& names) {
    const auto has = [&names](const std::string& id) { return std::ranges::count(names, id) > 0; };
    return has(cause.effect) || std::ranges::any_of(cause.alternatives, has);
  };
  return static_cast<double>(std::ranges::count_if(nested.named, is_named)) /
         static_cast<double>(nested.named.size());
}

}  // namespace flexspline::studies
