#pragma once

#include <string>
#include <vector>

#include "flexspline/reports/section.hpp"

namespace flexspline::reports {

/// A report before it is a page.
struct Document {
  std::string title;
  std::vector<Section> sections;
  std::string summary = {};  ///< file of its summary for print, beside the page; empty: none
};

/// The machine-readable twin, schema flexspline-report/1, with its checksum last.
std::string report_json(const Document& document);

/// The figures alone, by id, as the page unpacks them.
std::string figures_json(const Document& document);

}  // namespace flexspline::reports
