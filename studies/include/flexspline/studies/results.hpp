#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>

#include "flexspline/core/error.hpp"
#include "flexspline/studies/case_row.hpp"
#include "flexspline/studies/plan.hpp"

namespace flexspline::studies {

/// results.nc of a study's folder, from the rows of its case artefacts: netCDF-4, opens in xarray
/// and MATLAB, by the CF conventions. error_percent and error (N m) (input, estimator, amplitude,
/// frequency, replicate) hold the hold-out errors of the virtual bench; parameter_value and
/// parameter_std (input, estimator, replicate, parameter) the estimates, parameter_unit (input,
/// estimator, parameter) their units; row_* (row) every recording of every case, data sets
/// included. NaN, which is _FillValue, where there is none. Written under a temporary name and
/// renamed.
/// Errors: cannot_write.
Result<void> write_results(const StudyPlan& plan, std::span<const std::optional<CaseRow>> rows,
                           const std::map<std::string, std::string>& versions,
                           const std::filesystem::path& folder);

/// ro-crate-metadata.json: the folder as a process run crate (RO-Crate 1.1): program, inputs,
/// results. Errors: cannot_write.
Result<void> write_ro_crate(const StudyPlan& plan,
                            const std::map<std::string, std::string>& versions,
                            const std::filesystem::path& folder);

}  // namespace flexspline::studies
