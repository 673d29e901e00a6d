#include "diagnosis/names/nested_proof.hpp"

#include <algorithm>
#include <mutex>
#include <numeric>
#include <string>

#include <fmt/format.h>

#include "diagnosis/frame/folds.hpp"
#include "diagnosis/names/confirm.hpp"
#include "flexspline/core/in_parallel.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

constexpr std::size_t kMostAtOnce = 2;  // each holds a frame, and has threads of its own

/// How far searches that run side by side are together.
class JointProgress {
 public:
  JointProgress(const DiagnosisProgress& progress, std::size_t searches)
      : progress_(progress), share_(searches, 0.0) {}

  /// Of the search in all recordings (0), or without the k-th fold.
  DiagnosisProgress of(std::size_t k) {
    if (!progress_) return {};
    return [this, k](double share, std::string_view stage) {
      const std::scoped_lock lock(mutex_);
      share_[k] = share;
      const double all = static_cast<double>(share_.size());
      progress_(std::accumulate(share_.begin(), share_.end(), 0.0) / all,
                k == 0 ? std::string(stage)
                       : fmt::format("without fold {} of {}: {}", k, share_.size() - 1, stage));
    };
  }

 private:
  const DiagnosisProgress& progress_;
  std::mutex mutex_;
  std::vector<double> share_;
};

std::vector<std::string> ids_of(const Accepted& cause, const Selection& selection) {
  std::vector<std::string> ids = alternatives_of(cause, selection);
  ids.emplace_back(cause.trial.cause.row->id);
  return ids;
}

std::vector<FoundCause> found_by(const Selection& s) {
  std::vector<FoundCause> found;
  for (const Accepted& a : s.accepted) found.push_back({ids_of(a, s), a.probability, true});
  for (const Accepted& a : s.unnamed) found.push_back({ids_of(a, s), a.probability, false});
  return found;
}

bool shares_a_name(const FoundCause& found, const std::vector<std::string>& ids) {
  return std::ranges::find_first_of(found.ids, ids) != found.ids.end();
}

double probability_in(const std::vector<FoundCause>& found, const std::vector<std::string>& ids) {
  double most = 0.0;
  for (const FoundCause& one : found) {
    if (shares_a_name(one, ids)) most = std::max(most, one.probability);
  }
  return most;
}

Result<SearchedFold> search_without(const RecordingSet& all, const Frame& whole,
                                    const OuterFold& fold, const Limits& limits, Index most_rows,
                                    const DiagnosisProgress& progress) {
  auto frame = make_frame(without_rows(all, whole, fold.rows), most_rows);
  if (!frame) return tl::unexpected(frame.error());
  const auto finding =
      find_causes(std::move(*frame), limits, progress).and_then([&](Finding&& found) {
        return with_probable_names(std::move(found), limits);
      });
  if (!finding) return tl::unexpected(finding.error());
  SearchedFold searched{.found = found_by(finding->selection)};
  if (!fold.proves) return searched;
  auto judged = judge(whole, fold.rows, *finding);
  if (!judged) return tl::unexpected(judged.error());
  searched.held = std::move(judged->held);
  searched.before = std::move(judged->before.residual);
  searched.after = std::move(judged->after.residual);
  searched.of_motion = std::move(judged->of_motion);
  return searched;
}

/// Rows of all folds, and their residuals.
struct Pooled {
  ArrayXd held;
  PerEquation before, after;
  PerEquation of_motion;  ///< empty where no fold has it
};

bool has(const SearchedFold& fold, Equation equation) {
  return fold.after[index_of(equation)].size() > 0;
}

Pooled pooled(const Frame& whole, const std::vector<Result<SearchedFold>>& folds) {
  const ArrayXd zero = ArrayXd::Zero(whole.rows());
  Pooled pool{zero, {zero, zero, zero}, {zero, zero, zero}, {}};
  for (const auto& fold : folds) {
    pool.held += fold->held;
    for (Equation equation : whole.equations) {
      if (!has(*fold, equation)) continue;
      const std::size_t e = index_of(equation);
      pool.before[e] += fold->before[e] * fold->held;
      pool.after[e] += fold->after[e] * fold->held;
      if (fold->of_motion[e].size() == 0) continue;
      if (pool.of_motion[e].size() == 0) pool.of_motion[e] = zero;
      pool.of_motion[e] += fold->of_motion[e] * fold->held;
    }
  }
  return pool;
}

}  // namespace

Searches search_all(const RecordingSet& all, const Frame& whole, bool nested, const Limits& limits,
                    Index most_rows, const DiagnosisProgress& progress) {
  const auto folds = nested ? outer_folds(whole) : std::vector<OuterFold>{};
  Searches searches;
  std::vector<Result<SearchedFold>> found(folds.size(),
                                          failure(ErrorCode::numerics, "nothing was searched"));
  JointProgress steps(progress, 1 + folds.size());
  in_parallel(
      1 + folds.size(), std::min(kMostAtOnce, threads_for(limits.threads)), [&](std::size_t k) {
        if (k == 0) {
          searches.finding = find_causes(whole, limits, steps.of(0));
        } else {
          found[k - 1] = search_without(all, whole, folds[k - 1], limits, most_rows, steps.of(k));
        }
      });
  for (std::size_t k = 0; k < folds.size(); ++k) {
    if (folds[k].proves) {
      searches.folds.proving.push_back(std::move(found[k]));
    } else if (found[k]) {
      searches.folds.others.push_back(std::move(found[k]->found));
    }
  }
  return searches;
}

void judge_by_folds(const Frame& whole, const FoldSearches& searched, Finding& finding) {
  const auto& folds = searched.proving;
  const auto& [frame, selection, proof] = finding;
  if (folds.empty() || !std::ranges::all_of(folds, &Result<SearchedFold>::has_value)) return;
  const Pooled pool = pooled(whole, folds);
  const ArrayXd held = pool.held * frame.usable;
  if (held.sum() == 0.0) return;
  const auto judged = [&](Equation at) {
    return !frame.has(at) ||
           std::ranges::all_of(folds, [&](const auto& fold) { return has(*fold, at); });
  };
  for (std::size_t i = 0; i < selection.accepted.size(); ++i) {
    const CauseForm& form = *selection.accepted[i].trial.cause.form;
    if (!std::ranges::all_of(form.at, judged)) continue;
    NameEvidence& name = finding.proof.causes[i].name;
    take_errors(frame, selection.final, form, pool.before, pool.after, held, name);
    const auto ids = ids_of(selection.accepted[i], selection);
    name.in_folds.clear();
    for (const auto& fold : folds) name.in_folds.push_back(probability_in(fold->found, ids));
    for (const auto& found : searched.others) name.in_folds.push_back(probability_in(found, ids));
  }
}

Result<NestedProof> nested_proof(const Frame& whole, const FoldSearches& searched,
                                 Equation equation) {
  const auto& folds = searched.proving;
  const std::size_t e = index_of(equation);
  NestedProof nested{.found = searched.others};
  for (const auto& fold : folds) {
    if (!fold) return tl::unexpected(fold.error());
    if (!has(*fold, equation)) {
      return failure(ErrorCode::numerics, "the remaining recordings do not have this equation");
    }
    nested.found.push_back(fold->found);
  }
  const Pooled pool = pooled(whole, folds);
  nested.proof =
      proof_on(whole, pool.held, equation, pool.before[e], pool.after[e], pool.of_motion[e]);
  nested.proof.folds = static_cast<int>(folds.size());
  return nested;
}

double stability_of(const NestedProof& nested, const Cause& cause) {
  std::vector<std::string> ids = cause.alternatives;
  ids.push_back(cause.effect);
  const auto is_named = [&](const std::vector<FoundCause>& found) {
    return std::ranges::any_of(
        found, [&](const FoundCause& one) { return one.named && shares_a_name(one, ids); });
  };
  return static_cast<double>(std::ranges::count_if(nested.found, is_named)) /
         static_cast<double>(nested.found.size());
}

}  // namespace flexspline::studies
