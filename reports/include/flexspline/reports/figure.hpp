#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace flexspline::reports {

/// Who a series belongs to; the page gives each role one colour and one line style throughout.
/// measured | truth | published | estimator | plain | highlight, with the rank of the estimator in
/// the study or of a plain series in its panel. The name is a literal.
struct Role {
  std::string_view name = "estimator";
  int rank = 0;
};

/// One line, point set or band over x. A band has lower and upper beside y.
struct Series {
  std::string name;
  std::string style = "line";  ///< line | points | band
  Role role;
  std::vector<double> x, y, lower, upper;
};

struct Axis {
  std::string label;  ///< with its unit
  bool log = false;
  std::vector<std::string> categories;             ///< not empty: a category axis
  std::optional<std::pair<double, double>> range;  ///< where the data's own would hide what matters
};

/// A place on the x axis that means something, e.g. the end of the domain of validity.
struct Mark {
  double at = 0.0;
  std::string label;
};

/// A stretch of the x axis that is to be looked at.
struct Span {
  double from = 0.0;
  double to = 0.0;
};

/// A number in a heat map.
struct HeatCell {
  int column = 0;
  int row = 0;
  double value = 0.0;
  std::string note;  ///< shown with the number: trained | outside
};

/// One coordinate system: lines, or cells of a heat map.
struct Panel {
  std::string title;
  Axis x, y;
  std::vector<Series> series;
  std::vector<Mark> marks;
  std::vector<Span> spans;
  std::vector<HeatCell> cells;
};

/// What a figure shows for one choice of its pickers.
struct Frame {
  std::vector<std::string> choice;
  std::vector<Panel> panels;
};

/// A figure, free of any plotting library.
struct Figure {
  std::string id;
  std::string kind = "lines";  ///< lines | heatmap | scatter
  std::string title, caption, alt;
  std::vector<std::string> pickers;  ///< name of each element of a frame's choice
  std::vector<Frame> frames;
  std::string derived_from;  ///< id of a figure whose frames this one shows, less its first series
  std::string y_label;       ///< of a derived figure
  std::optional<std::pair<double, double>> scale;  ///< of the colours of a heat map, logarithmic
  std::string cell_unit = "% of peak";             ///< of the numbers of a heat map
};

}  // namespace flexspline::reports
