#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

#include "flexspline/core/case_store.hpp"
#include "flexspline/core/error.hpp"
#include "flexspline/studies/case_row.hpp"
#include "flexspline/studies/plan.hpp"

namespace flexspline::studies {

/// The rows of a plan's cases as a folder holds them, one after the other: however many there are,
/// only one is in memory (of a few thousand, all).
class StudyRows {
 public:
  using Visit = std::function<void(const CasePlan&, const CaseRow&)>;

  /// The plan has to outlive it. Errors: of CaseStore::open.
  static Result<StudyRows> open(const StudyPlan& plan, const std::filesystem::path& folder);

  const StudyPlan& plan() const { return *plan_; }
  const StudyConfig& study() const { return *plan_->study; }
  /// Every case that is there and did not fail, in the order of the plan.
  void each(const Visit& visit) const;
  /// How many cases are there, and how many of them failed.
  std::size_t done() const { return done_; }
  std::size_t failed() const { return failed_; }

 private:
  StudyRows(const StudyPlan& plan, CaseStore store) : plan_(&plan), store_(std::move(store)) {}

  const StudyPlan* plan_;
  CaseStore store_;
  std::vector<std::pair<std::size_t, CaseRow>> kept_;  ///< all, where they are few
  bool all_kept_ = false;
  std::size_t done_ = 0;
  std::size_t failed_ = 0;
};

}  // namespace flexspline::studies
