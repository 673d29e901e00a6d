#include "flexspline/reports/draw_figures.hpp"

#include "document_json.hpp"
#include "static_figures.hpp"

namespace flexspline::reports {

Result<void> draw_figures(const std::filesystem::path& folder, const std::vector<Figure>& figures) {
  Document document{"", {Section{"figures", "", {}}}};
  for (const Figure& figure : figures) document.sections.front().add(figure);
  return write_static_figures(folder, figures_json(document));
}

}  // namespace flexspline::reports
