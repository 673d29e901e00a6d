#include "flexspline/studies/study_rows.hpp"

#include "results/row_json.hpp"

namespace flexspline::studies {
namespace {

constexpr std::size_t kMostKept = 5000;

}  // namespace

Result<StudyRows> StudyRows::open(const StudyPlan& plan, const std::filesystem::path& folder) {
  auto store = CaseStore::open(folder);
  if (!store) return tl::unexpected(store.error());
  StudyRows rows(plan, std::move(*store));
  rows.done_ = rows.store_.size();
  rows.failed_ = rows.store_.failed();
  if (plan.size() > kMostKept) return rows;
  rows.each([&, number = std::size_t{0}](const CasePlan& one, const CaseRow& row) mutable {
    while (plan.at(number).key != one.key) ++number;
    rows.kept_.emplace_back(number, row);
  });
  rows.all_kept_ = true;
  return rows;
}

void StudyRows::each(const Visit& visit) const {
  if (all_kept_) {
    for (const auto& [number, row] : kept_) visit(plan_->at(number), row);
    return;
  }
  for (std::size_t number = 0; number < plan_->size(); ++number) {
    const CasePlan one = plan_->at(number);
    const CaseStore::Digest digest = CaseStore::digest_of(one.depends_on);
    if (!store_.contains(digest)) continue;
    const auto stored = store_.read(digest);
    if (!stored || stored->failed()) continue;
    if (const auto row = row_from_json(stored->row)) visit(one, *row);
  }
}

}  // namespace flexspline::studies
