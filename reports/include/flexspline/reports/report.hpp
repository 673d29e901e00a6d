#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "flexspline/core/error.hpp"

namespace flexspline::reports {

/// A report that was drawn.
struct WrittenReport {
  std::filesystem::path page;
  std::vector<std::string> left_out;  ///< "cases/a.json: reason" of every artefact it is without
};

/// Draws the report of a folder from the artefacts in it alone (docs/artefacts.md): of a diagnosis
/// (diagnosis.json: index.html), else of a trial (trial.json: report/index.html), else of a
/// verification (verification.json: index.html), else of a study, fit or comparison
/// (report/index.html); with report/report.json, report/figures/*.svg (drawn by
/// node where that is on PATH) and tables/*.csv|.md|.tex.
/// The same artefacts give the same bytes. What is absent is left out; artefacts that cannot be
/// read, or of which study.lock.toml says that they should be there, are named on top of the page.
/// Errors: input_missing where the folder holds no artefact at all; bad_data for a diagnosis or
/// trial that cannot be read; cannot_write.
Result<WrittenReport> write_report(const std::filesystem::path& folder);

}  // namespace flexspline::reports
