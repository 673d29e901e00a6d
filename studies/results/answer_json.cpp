#include <cmath>

#include <algorithm>

#include <nlohmann/json.hpp>

#include "flexspline/data/artefact.hpp"
#include "flexspline/studies/kind.hpp"
#include "flexspline/studies/results.hpp"

namespace flexspline::studies {
namespace {

using nlohmann::ordered_json;

ordered_json series_json(const AnswerSeries& series) {
  ordered_json object = {
      {"name", series.name}, {"style", series.style}, {"x", series.x}, {"y", series.y}};
  if (!series.lower.empty()) {
    object["lower"] = series.lower;
    object["upper"] = series.upper;
  }
  return object;
}

ordered_json panel_json(const AnswerPanel& panel) {
  ordered_json object = {{"title", panel.title},     {"x_label", panel.x_label},
                         {"y_label", panel.y_label}, {"x_log", panel.x_log},
                         {"y_log", panel.y_log},     {"x_names", panel.x_names},
                         {"y_names", panel.y_names}, {"series", ordered_json::array()},
                         {"cells", panel.cells}};
  for (const AnswerSeries& one : panel.series) object["series"].push_back(series_json(one));
  return object;
}

ordered_json figure_json(const AnswerFigure& figure) {
  ordered_json object = {{"id", figure.id},
                         {"title", figure.title},
                         {"caption", figure.caption},
                         {"cell_unit", figure.cell_unit},
                         {"panels", ordered_json::array()}};
  for (const AnswerPanel& one : figure.panels) object["panels"].push_back(panel_json(one));
  return object;
}

ordered_json table_json(const AnswerTable& table) {
  ordered_json object = {{"id", table.id},
                         {"caption", table.caption},
                         {"columns", table.columns},
                         {"rows", ordered_json::array()}};
  for (const auto& row : table.rows) {
    ordered_json cells = ordered_json::array();
    for (const auto& cell : row) {
      std::visit([&](const auto& value) { cells.push_back(value); }, cell);
    }
    object["rows"].push_back(std::move(cells));
  }
  return object;
}

}  // namespace

ordered_json to_json(const KindAnswer& answer) {
  ordered_json object = {{"says", answer.says},
                         {"notes", answer.notes},
                         {"figures", ordered_json::array()},
                         {"tables", ordered_json::array()}};
  for (const AnswerFigure& one : answer.figures) object["figures"].push_back(figure_json(one));
  for (const AnswerTable& one : answer.tables) object["tables"].push_back(table_json(one));
  return object;
}

Result<void> write_answer(const StudyRows& rows, const std::filesystem::path& folder) {
  const StudyConfig& study = rows.study();
  const KindRow* kind = find_kind(study.kind);
  std::error_code ignored;
  std::filesystem::remove(folder / "kind.json", ignored);
  if (kind == nullptr || kind->answer == nullptr) return {};
  const KindAnswer answer = kind->answer(rows);
  if (answer.says.empty()) return {};
  ordered_json artefact = {
      {"schema", "flexspline-kind/1"}, {"kind", kind->id}, {"question", kind->question}};
  artefact.update(to_json(answer));
  artefact["cases"] = rows.plan().size();
  artefact["done"] = rows.done();
  artefact["failed"] = rows.failed();
  return data::write_artefact(folder / "kind.json", std::move(artefact));
}

}  // namespace flexspline::studies
