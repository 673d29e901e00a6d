#include "flexspline/reports/diagnosis_view.hpp"
#include "numbers.hpp"

namespace flexspline::reports {
namespace {

std::string label_of(const ShownTableAxis& axis) {
  return words(axis.coordinate) + (axis.unit == "1" ? "" : ", " + axis.unit);
}

/// The torque over the first coordinate; one line a knot of the second.
Figure table_figure(const ShownUnnamed& part) {
  const ShownTableAxis& over = part.axes.front();
  const std::size_t lines = part.axes.size() > 1 ? part.axes.back().values.size() : 1;
  Panel panel;
  panel.x.label = label_of(over);
  panel.y.label = "torque, " + part.torque_unit;
  for (std::size_t k = 0; k < lines; ++k) {
    Series line;
    line.name = lines == 1 ? "table"
                           : words(part.axes.back().coordinate) + " " +
                                 compact(part.axes.back().values[k], 3) +
                                 (part.axes.back().unit == "1" ? "" : " " + part.axes.back().unit);
    line.role = {"plain", static_cast<int>(k)};
    line.x = over.values;
    for (std::size_t i = 0; i < over.values.size(); ++i)
      line.y.push_back(part.torque[i * lines + k]);
    panel.series.push_back(std::move(line));
  }
  Figure figure;
  figure.id = "unnamed";
  figure.title = "What is left, as a function";
  figure.caption =
      "Torque that the model misses, by a table that is linear between its knots and whose size is "
      "judged by the recordings' noise.";
  figure.alt = "The torque that the model misses over the " + words(over.coordinate) + ".";
  figure.frames = {{{}, {std::move(panel)}}};
  return figure;
}

Table numbers_of(const ShownUnnamed& part) {
  Table table{"unnamed-table", "The table itself.", {}, {}};
  for (const ShownTableAxis& axis : part.axes) {
    table.columns.push_back({words(axis.coordinate), axis.unit == "1" ? "" : axis.unit, 4});
  }
  table.columns.push_back({"torque", part.torque_unit, 4});
  const std::size_t inner = part.axes.size() > 1 ? part.axes.back().values.size() : 1;
  for (std::size_t at = 0; at < part.torque.size(); ++at) {
    std::vector<Cell> row = {part.axes.front().values[at / inner], part.torque[at]};
    if (part.axes.size() > 1) row.insert(row.begin() + 1, part.axes.back().values[at % inner]);
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::optional<Section> draw(const DiagnosisView& view) {
  if (!view.unnamed) return std::nullopt;
  Section section{"unnamed-section", "What is left that no catalogued effect explains?", {}};
  section.add(Verdict{sentence(view.unnamed->says)});
  section.add(table_figure(*view.unnamed));
  section.fold("The numbers", numbers_of(*view.unnamed));
  return section;
}

}  // namespace

DiagnosisSectionRow describe_unnamed() { return {25, draw}; }

}  // namespace flexspline::reports
