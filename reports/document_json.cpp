#include "document_json.hpp"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "checksum.hpp"
#include "extent.hpp"
#include "numbers.hpp"

namespace flexspline::reports {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kDrawnDigits = 4;  ///< a 2000-pixel picture shows no more

/// What moves little about a large value needs the more digits.
std::vector<double> drawn(const std::vector<double>& values, int more = 0) {
  Extent extent;
  extent.take(values);
  const double offset = extent.reach() / (extent.upper - extent.lower);
  if (std::isfinite(offset) && offset > 2.0) more += static_cast<int>(std::log10(offset)) + 1;
  return rounded(values, kDrawnDigits + std::min(more, 9));
}

Json axis_json(const Axis& axis) {
  Json json = {{"label", axis.label}};
  if (axis.log) json["log"] = true;
  if (!axis.categories.empty()) json["categories"] = axis.categories;
  if (axis.range) json["range"] = {axis.range->first, axis.range->second};
  return json;
}

/// Series of one panel often share their x: it is written once, and reused where absent.
Json series_json(const Series& series, const std::vector<double>& x_before) {
  Json json = {{"name", series.name},
               {"style", series.style},
               {"role", series.role.name},
               {"rank", series.role.rank}};
  if (series.x != x_before) json["x"] = drawn(series.x, 1);
  json["y"] = drawn(series.y);
  if (!series.lower.empty()) {
    json["lower"] = drawn(series.lower);
    json["upper"] = drawn(series.upper);
  }
  return json;
}

Json panel_json(const Panel& panel) {
  Json json = {{"title", panel.title}, {"x", axis_json(panel.x)}, {"y", axis_json(panel.y)}};
  json["series"] = Json::array();
  const std::vector<double> none;
  const std::vector<double>* x = &none;
  for (const Series& series : panel.series) {
    json["series"].push_back(series_json(series, *x));
    x = &series.x;
  }
  for (const Mark& mark : panel.marks) {
    json["marks"].push_back({{"at", mark.at}, {"label", mark.label}});
  }
  for (const Span& span : panel.spans) json["spans"].push_back({span.from, span.to});
  for (const HeatCell& cell : panel.cells) {
    json["cells"].push_back({cell.column, cell.row, rounded(cell.value, 3), cell.note});
  }
  return json;
}

Json figure_json(const Figure& figure) {
  Json json = {{"id", figure.id},           {"kind", figure.kind}, {"title", figure.title},
               {"caption", figure.caption}, {"alt", figure.alt},   {"pickers", figure.pickers}};
  if (figure.scale) json["scale"] = {figure.scale->first, figure.scale->second};
  if (figure.kind == "heatmap") json["cell_unit"] = figure.cell_unit;
  if (!figure.derived_from.empty()) {
    json["derived_from"] = figure.derived_from;
    json["y_label"] = figure.y_label;
  }
  json["frames"] = Json::array();
  for (const Frame& frame : figure.frames) {
    Json panels = Json::array();
    for (const Panel& panel : frame.panels) panels.push_back(panel_json(panel));
    json["frames"].push_back({{"choice", frame.choice}, {"panels", std::move(panels)}});
  }
  return json;
}

Json table_json(const Table& table) {
  Json json = {{"id", table.id}, {"caption", table.caption}};
  json["columns"] = Json::array();
  for (const Column& column : table.columns) {
    json["columns"].push_back({{"name", column.name}, {"unit", column.unit}});
  }
  json["rows"] = Json::array();
  for (const auto& row : table.rows) {
    Json cells = Json::array();
    for (const Cell& cell : row) std::visit([&](const auto& v) { cells.push_back(v); }, cell);
    json["rows"].push_back(std::move(cells));
  }
  return json;
}

struct ContentJson {
  Json operator()(const Verdict& verdict) const { return {{"verdict", verdict.text}}; }
  Json operator()(const Paragraph& paragraph) const { return {{"paragraph", paragraph.text}}; }
  Json operator()(const Heading& heading) const { return {{"heading", heading.text}}; }
  Json operator()(const Listing& listing) const { return {{"listing", listing.text}}; }
  Json operator()(const Equation& equation) const { return {{"equation", equation.text}}; }
  Json operator()(const Figure& figure) const { return {{"figure", figure_json(figure)}}; }
  Json operator()(const Table& table) const { return {{"table", table_json(table)}}; }
};

/// Bytes that are no UTF-8 become U+FFFD: a hostile name must not stop a report.
std::string dump(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

std::string report_json(const Document& document) {
  Json json = {{"schema", "flexspline-report/1"}, {"title", document.title}};
  json["sections"] = Json::array();
  for (const Section& section : document.sections) {
    Json blocks = Json::array();
    for (const Block& block : section.blocks) {
      Json content = std::visit(ContentJson{}, block.content);
      if (!block.folded_under.empty()) content["folded_under"] = block.folded_under;
      blocks.push_back(std::move(content));
    }
    json["sections"].push_back(
        {{"id", section.id}, {"title", section.title}, {"blocks", std::move(blocks)}});
  }
  json["sha256"] = sha256_of(dump(json));
  return dump(json) + "\n";
}

std::string figures_json(const Document& document) {
  Json figures = Json::object();
  for (const Section& section : document.sections) {
    for (const Block& block : section.blocks) {
      if (const auto* figure = std::get_if<Figure>(&block.content)) {
        figures[figure->id] = figure_json(*figure);
      }
    }
  }
  return dump(figures);
}

}  // namespace flexspline::reports
