#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "flexspline/data/checksum.hpp"
#include "plan/variant_plan.hpp"

namespace flexspline::studies {

namespace {

/// Whether a cell has cases at that point: its own sweeps anywhere, the others at their beginning.
bool stands_at(const Cell& cell, const std::vector<std::size_t>& point) {
  for (std::size_t s = 0; s < point.size(); ++s) {
    if (!cell.swept[s] && point[s] != 0) return false;
  }
  return true;
}

}  // namespace

std::size_t variants_of(const StudyConfig& study) {
  std::size_t count = 1;
  for (const SweepAxis& sweep : study.sweeps) count *= sweep.points.size();
  return count;
}

std::vector<std::size_t> point_of(const StudyConfig& study, std::size_t variant) {
  std::vector<std::size_t> point(study.sweeps.size());
  for (std::size_t s = point.size(); s-- > 0;) {
    const std::size_t size = study.sweeps[s].points.size();
    point[s] = variant % size;
    variant /= size;
  }
  return point;
}

void StudyPlan::number_cells() {
  const std::size_t variants = variants_of(*study);
  first_.assign(1, 0);
  first_.reserve(variants + 1);
  for (std::size_t v = 0; v < variants; ++v) {
    const auto point = point_of(*study, v);
    const auto here =
        std::ranges::count_if(cells, [&](const Cell& cell) { return stands_at(cell, point); });
    first_.push_back(first_.back() + static_cast<std::size_t>(here));
  }
}

CasePlace StudyPlan::place(std::size_t number) const {
  const auto replicates = static_cast<std::size_t>(study->replicates);
  const auto after = std::ranges::upper_bound(first_, number / replicates);
  CasePlace place;
  place.variant = static_cast<std::size_t>(after - first_.begin()) - 1;
  const std::size_t here = first_[place.variant + 1] - first_[place.variant];
  const std::size_t within = number - first_[place.variant] * replicates;
  place.replicate = within / here;
  std::size_t left = within % here;
  const auto point = point_of(*study, place.variant);
  for (; place.cell < cells.size(); ++place.cell) {
    if (stands_at(cells[place.cell], point) && left-- == 0) break;
  }
  return place;
}

std::shared_ptr<const VariantPlan> StudyPlan::variant(std::size_t number) const {
  return variants_->take(number, [&] {
    VariantPlan planned;
    if (study->sweeps.empty()) {
      planned.study = std::shared_ptr<const StudyConfig>(std::shared_ptr<void>(), study);
    } else if (auto made = variant_study(*study, number); made) {
      planned.study = std::make_shared<const StudyConfig>(std::move(*made));
    } else {
      planned.problem = made.error();
      planned.study = std::shared_ptr<const StudyConfig>(std::shared_ptr<void>(), study);
    }
    for (const Cell& cell : cells) {
      auto one = plan_cell(*this, *planned.study, cell);
      if (!one && !planned.problem) planned.problem = one.error();
      planned.cells.push_back(one ? std::move(*one) : CellPlan{});
    }
    return planned;
  });
}

CasePlan StudyPlan::at(std::size_t number) const {
  const CasePlace where = place(number);
  const auto whole = variant(where.variant);
  const CellPlan& cell = whole->cells.at(where.cell);
  CasePlan one;
  one.study = whole->study;
  one.input = &one.study->inputs.at(cells[where.cell].input);
  one.estimator = &one.study->estimators.at(cells[where.cell].estimator);
  one.variant = where.variant;
  one.replicate = static_cast<int>(where.replicate);
  one.seed = seed_of(*one.study, one.replicate);
  const std::string swept = study->sweeps.empty() ? "" : fmt::format("--v{}", one.variant);
  one.key = fmt::format("{}--{}{}--r{}", one.input->id, one.estimator->id, swept, one.replicate);
  one.train = cell.train;
  one.holdout = cell.holdout;
  one.train_samples = cell.train_samples;
  one.problem = whole->problem;
  const bool drawn = !one.input->truth.empty();
  one.fit_depends_on =
      drawn ? data::sha256_hex(fmt::format("{} {}", cell.fit, one.seed)) : cell.fit;
  one.depends_on = data::sha256_hex(
      fmt::format("{}\n{}\n{}\n{}", build_id_, one.key, one.fit_depends_on, cell.whole));
  return one;
}

InputPlan StudyPlan::input_of(const CasePlan& one) const {
  return variant(one.variant)->input(*this, *one.input, one.replicate);
}

std::size_t StudyPlan::cases_of(const Cell& cell) const {
  auto count = static_cast<std::size_t>(study->replicates);
  for (std::size_t s = 0; s < cell.swept.size(); ++s) {
    if (cell.swept[s]) count *= study->sweeps[s].points.size();
  }
  return count;
}

std::size_t StudyPlan::unique_fits() const {
  std::set<std::string> seen;
  std::size_t fits = 0;
  const auto first = variant(0);
  for (std::size_t c = 0; c < cells.size(); ++c) {
    if (!seen.insert(first->cells[c].fit).second) continue;
    const bool drawn = !study->inputs[cells[c].input].truth.empty();
    const auto replicates = static_cast<std::size_t>(study->replicates);
    fits += drawn ? cases_of(cells[c]) : cases_of(cells[c]) / replicates;
  }
  return fits;
}

}  // namespace flexspline::studies
