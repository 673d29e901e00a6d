#include "diagnosis/nested_proof.hpp"

#include <algorithm>
#include <mutex>
#include <numeric>
#include <optional>

#include <fmt/format.h>

#include "diagnosis/folds.hpp"
#include "diagnosis/spelled.hpp"
#include "flexspline/core/in_parallel.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

/// How far folds that are searched side by side are together.
class FoldProgress {
 public:
  FoldProgress(const DiagnosisProgress& progress, std::size_t folds)
      : progress_(progress), share_(folds, 0.0) {}

  DiagnosisProgress of(std::size_t fold) {
    if (!progress_) return {};
    return [this, fold](double share, std::string_view stage) {
      const std::scoped_lock lock(mutex_);
      share_[fold] = share;
      const double folds = static_cast<double>(share_.size());
      progress_(std::accumulate(share_.begin(), share_.end(), 0.0) / folds,
                fmt::format("without fold {} of {}: {}", fold + 1, share_.size(), stage));
    };
  }

 private:
  const DiagnosisProgress& progress_;
  std::mutex mutex_;
  std::vector<double> share_;
};

constexpr std::size_t kMostAtOnce = 2;  // each holds a frame, and its search has threads of its own

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
  FoldProgress steps(progress, folds.size());
  std::vector<std::optional<Result<SearchedFold>>> searched(folds.size());
  in_parallel(folds.size(), std::min(kMostAtOnce, threads_for(limits.threads)), [&](std::size_t k) {
    searched[k].emplace(
        search_without(all, *whole, folds[k], equation, limits, most_rows, steps.of(k)));
  });
  for (auto& one : searched) {
    if (!*one) return tl::unexpected(one->error());
    const auto& [judged, named] = **one;
    nested.named.push_back(named);
    held += judged.held;
    before += judged.residual_before * judged.held;
    after += judged.residual_after * judged.held;
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
