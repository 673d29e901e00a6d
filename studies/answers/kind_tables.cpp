#include "answers/kind_tables.hpp"

#include <fmt/format.h>

#include "flexspline/core/nearest_name.hpp"

namespace flexspline::studies {

const Grid* named_grid(TomlSection& own, std::string_view key, const StudyConfig& study) {
  if (!own.has(key) && study.grids.size() == 1) {
    static_cast<void>(own.node(key));
    return &study.grids.front();
  }
  const std::string id = own.required_text(key);
  if (const Grid* grid = study.find_grid(id)) return grid;
  std::vector<std::string_view> names;
  for (const Grid& grid : study.grids) names.emplace_back(grid.id);
  if (!id.empty()) {
    own.refuse(key, fmt::format("'{}' = \"{}\" is not a grid of this study", own.name_of(key), id),
               suggestion(id, names));
  }
  return nullptr;
}

double percent_of(TomlSection& own, std::string_view key, double otherwise) {
  const auto share = own.quantity(key, Dimension::dimensionless, 0.0);
  return share ? 100.0 * *share : otherwise;
}

void need_truths(TomlSection& own, const StudyConfig& study) {
  for (const InputConfig& input : study.inputs) {
    if (!input.truth.empty()) continue;
    own.refuse("",
               fmt::format("input '{}' is a data set, and a study of kind {} needs the truth",
                           input.id, study.kind),
               "give it a truth = \"…\" of the virtual bench");
  }
}

void hold_out_everywhere(StudyConfig& study, const std::string& grid) {
  for (InputConfig& input : study.inputs) {
    if (!input.truth.empty() && input.holdout.empty()) input.holdout = grid;
  }
}

EstimatorConfig made_from(const EstimatorConfig& written, const std::string& suffix) {
  EstimatorConfig made = written;
  made.made_from = written.written_id();
  made.id = fmt::format("{}.{}", written.id, suffix);
  return made;
}

}  // namespace flexspline::studies
