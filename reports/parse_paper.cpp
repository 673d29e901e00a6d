#include <cmath>

#include <nlohmann/json.hpp>

#include "json_fields.hpp"
#include "parse_artefacts.hpp"

namespace flexspline::reports {
namespace {

using nlohmann::json;

/// `published` is a text in the contract; a bare number is taken too.
std::string words_in(const json& object, const char* key) {
  const json& value = member(object, key);
  return value.is_number() ? value.dump() : text_in(object, key);
}

Fact parse_fact(const json& from) {
  Fact fact{text_in(from, "id"), text_in(from, "says"), text_in(from, "unit"),
            words_in(from, "published")};
  fact.value = number_in(from, "value");
  const double digits = number_in(from, "digits");
  fact.digits = std::isfinite(digits) ? static_cast<int>(digits) : 0;
  return fact;
}

PaperFigure parse_figure(const json& from) {
  PaperFigure figure;
  figure.id = text_in(from, "id");
  figure.title = text_in(from, "title");
  figure.x_label = text_in(from, "x_label");
  figure.y_label = text_in(from, "y_label");
  figure.says = text_in(from, "says");
  figure.wrong = text_in(from, "wrong");
  for (const json& series : member(from, "series")) {
    figure.series.push_back({text_in(series, "name"), text_in(series, "side"),
                             text_in(series, "style") == "points", numbers_in(series, "x"),
                             numbers_in(series, "y")});
  }
  return figure;
}

}  // namespace

Paper parse_paper(const json& artefact) {
  Paper paper;
  for (const json& fact : member(artefact, "facts")) paper.facts.push_back(parse_fact(fact));
  for (const json& row : member(artefact, "table_1")) {
    paper.table_1.push_back({text_in(row, "name"), text_in(row, "unit"),
                             number_in(row, "published"), number_in(row, "recovered"),
                             number_in(row, "std")});
  }
  for (const json& row : member(artefact, "table_2")) {
    paper.table_2.push_back({text_in(row, "name"), words_in(row, "value"), words_in(row, "ours"),
                             text_in(row, "unit"), text_in(row, "says")});
  }
  for (const json& slip : member(artefact, "slips")) {
    paper.slips.push_back(
        {text_in(slip, "where"), text_in(slip, "printed"), text_in(slip, "meant")});
  }
  for (const json& figure : member(artefact, "figures")) {
    paper.figures.push_back(parse_figure(figure));
  }
  return paper;
}

}  // namespace flexspline::reports
