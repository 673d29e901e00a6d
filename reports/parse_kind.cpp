#include <cmath>
#include <map>

#include <nlohmann/json.hpp>

#include "extent.hpp"
#include "json_fields.hpp"
#include "numbers.hpp"
#include "parse_artefacts.hpp"

namespace flexspline::reports {
namespace {

using nlohmann::json;

Axis parse_axis(const json& panel, const char* label, const char* log, const char* names) {
  Axis axis;
  axis.label = text_in(panel, label);
  axis.log = flag_in(panel, log);
  axis.categories = texts_in(panel, names);
  return axis;
}

/// An axis is as long as its lines and points; what a band reaches has to be in view as well.
void show_whole_bands(Panel& panel) {
  Extent values;
  bool any = false;
  for (const Series& one : panel.series) {
    any = any || one.style == "band";
    for (const auto* list : {&one.y, &one.lower, &one.upper}) values.take(*list);
  }
  if (any && !panel.y.log && !values.empty()) {
    panel.y.range = widened(values.lower, values.upper, 0.05);
  }
}

Panel parse_panel(const json& from) {
  Panel panel;
  panel.title = text_in(from, "title");
  panel.x = parse_axis(from, "x_label", "x_log", "x_names");
  panel.y = parse_axis(from, "y_label", "y_log", "y_names");
  std::map<std::string, int> ranks;  // a band and a line of one name belong together
  for (const json& one : member(from, "series")) {
    const std::string name = text_in(one, "name");
    const int rank = ranks.try_emplace(name, static_cast<int>(ranks.size())).first->second;
    panel.series.push_back({name,
                            text_in(one, "style"),
                            {"plain", rank},
                            numbers_in(one, "x"),
                            numbers_in(one, "y"),
                            numbers_in(one, "lower"),
                            numbers_in(one, "upper")});
  }
  show_whole_bands(panel);
  int row = 0;
  for (const json& cells : member(from, "cells")) {
    int column = 0;
    for (const json& cell : cells) {
      const double value = cell.is_number() ? cell.get<double>() : kAbsent;
      if (value == value) panel.cells.push_back({column, row, value, ""});
      ++column;
    }
    ++row;
  }
  return panel;
}

Figure parse_figure(const json& from) {
  Figure figure;
  figure.id = text_in(from, "id");
  figure.title = text_in(from, "title");
  figure.caption = text_in(from, "caption");
  figure.alt = figure.title + ". " + figure.caption;
  figure.cell_unit = text_in(from, "cell_unit");
  Frame frame;
  for (const json& panel : member(from, "panels")) frame.panels.push_back(parse_panel(panel));
  if (!frame.panels.empty() && !frame.panels.front().cells.empty()) figure.kind = "heatmap";
  figure.frames.push_back(std::move(frame));
  return figure;
}

/// Whether a column holds whole numbers and nothing else that is a number.
bool counts(const json& rows, std::size_t column) {
  bool any = false;
  for (const json& row : rows) {
    if (!row.is_array() || column >= row.size() || !row[column].is_number()) continue;
    const double value = row[column].get<double>();
    if (value != std::round(value) || std::abs(value) > 1e9) return false;
    any = true;
  }
  return any;
}

Table parse_table(const json& from) {
  Table table{text_in(from, "id"), text_in(from, "caption"), {}, {}};
  const auto names = texts_in(from, "columns");
  for (std::size_t k = 0; k < names.size(); ++k) {
    table.columns.push_back({names[k], "", counts(member(from, "rows"), k) ? 0 : 3});
  }
  for (const json& row : member(from, "rows")) {
    auto& cells = table.rows.emplace_back();
    for (const json& cell : row) {
      if (cell.is_string())
        cells.emplace_back(cell.get<std::string>());
      else
        cells.emplace_back(cell.is_number() ? cell.get<double>() : kAbsent);
    }
  }
  return table;
}

}  // namespace

Kind parse_kind(const json& artefact) {
  Kind kind;
  kind.kind = text_in(artefact, "kind");
  kind.question = text_in(artefact, "question");
  kind.says = text_in(artefact, "says");
  kind.notes = texts_in(artefact, "notes");
  kind.cases = number_in(artefact, "cases");
  kind.done = number_in(artefact, "done");
  kind.failed = number_in(artefact, "failed");
  for (const json& one : member(artefact, "figures")) kind.figures.push_back(parse_figure(one));
  for (const json& one : member(artefact, "tables")) kind.tables.push_back(parse_table(one));
  return kind;
}

}  // namespace flexspline::reports
