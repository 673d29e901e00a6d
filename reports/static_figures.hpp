#pragma once

#include <filesystem>
#include <string_view>

#include "flexspline/core/error.hpp"

namespace flexspline::reports {

/// Every figure as it is first shown, as FOLDER/<id>.svg: the page's own program run by node, which
/// has to be on PATH. Where it is not, or fails, FOLDER/not-drawn.txt says so and nothing else
/// changes. `figures` is figures_json of the document.
/// Errors: cannot_write.
Result<void> write_static_figures(const std::filesystem::path& folder, std::string_view figures);

}  // namespace flexspline::reports
