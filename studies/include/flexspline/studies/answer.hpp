#pragma once

#include <string>
#include <variant>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace flexspline::studies {

/// One line, point set or band over x.
struct AnswerSeries {
  std::string name;
  std::string style = "line";  ///< line | points | band
  std::vector<double> x, y, lower{}, upper{};
};

/// Lines over an axis, or numbers in cells where `cells` holds rows.
struct AnswerPanel {
  std::string title;
  std::string x_label, y_label;
  bool x_log = false, y_log = false;
  std::vector<std::string> x_names{}, y_names{};  ///< of the categories of an axis
  std::vector<AnswerSeries> series{};
  std::vector<std::vector<double>> cells{};  ///< [row][column]
};

struct AnswerFigure {
  std::string id, title, caption;
  std::string cell_unit{};
  std::vector<AnswerPanel> panels;
};

struct AnswerTable {
  std::string id, caption;
  std::vector<std::string> columns;  ///< with their units
  std::vector<std::vector<std::variant<std::string, double>>> rows;
};

/// What a study of a kind says: the sentence that answers its question, figures and tables. The
/// artefact kind.json (docs/artefacts.md).
struct KindAnswer {
  std::string says;
  std::vector<std::string> notes{};
  std::vector<AnswerFigure> figures{};
  std::vector<AnswerTable> tables{};
};

nlohmann::ordered_json to_json(const KindAnswer& answer);

}  // namespace flexspline::studies
