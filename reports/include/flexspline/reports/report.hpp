#pragma once

#include <filesystem>

#include "flexspline/core/error.hpp"

namespace flexspline::reports {

/// Draws the report of a study, fit or comparison from the artefacts in its folder alone
/// (docs/artefacts.md): report/index.html, report/report.json and tables/*.csv|.md|.tex.
/// The same artefacts give the same bytes. What is absent is left out; artefacts that cannot be
/// read are named in the report. Gives the path of the page.
/// Errors: input_missing where the folder holds no artefact at all; cannot_write.
Result<std::filesystem::path> write_report(const std::filesystem::path& study_folder);

}  // namespace flexspline::reports
