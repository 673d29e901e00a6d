#pragma once

#include <string>
#include <string_view>

#include "document_json.hpp"

namespace flexspline::reports {

/// One HTML page that needs nothing else: text and tables as markup, figures as data with the
/// program that draws them. figures: figures_json(document).
std::string page_of(const Document& document, std::string_view figures);

/// Text as HTML shows it.
std::string escaped(std::string_view text);

/// The bundled front end (reports/assets), embedded at build time.
std::string page_script();
std::string page_style();

}  // namespace flexspline::reports
