#pragma once

#include <filesystem>
#include <vector>

#include "flexspline/core/error.hpp"
#include "flexspline/reports/figure.hpp"

namespace flexspline::reports {

/// Every figure as FOLDER/<id>.svg, drawn by node where that is on PATH; where it is not,
/// FOLDER/not-drawn.txt says so. Errors: cannot_write.
Result<void> draw_figures(const std::filesystem::path& folder, const std::vector<Figure>& figures);

}  // namespace flexspline::reports
