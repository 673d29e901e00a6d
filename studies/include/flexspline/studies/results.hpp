#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "flexspline/core/error.hpp"
#include "flexspline/studies/study_rows.hpp"

namespace flexspline::studies {

/// results.nc of a study's folder, from the rows of its cases: netCDF-4, opens in xarray and
/// MATLAB, by the CF conventions. error_percent and error (N m) (input, estimator, amplitude,
/// frequency, replicate) hold the hold-out errors of the virtual bench; parameter_value and
/// parameter_std (input, estimator, replicate, parameter) the estimates, parameter_unit (input,
/// estimator, parameter) their units; case_* (input, estimator, replicate) the numbers of a case's
/// row; row_* (row) every recording of every case, data sets included. Where the study is swept,
/// variant comes before the other dimensions, and sweep_* (variant) says what was swept. NaN, which
/// is _FillValue, where there is none. Written block by block, under a temporary name, and renamed.
/// Errors: cannot_write.
Result<void> write_results(const StudyRows& rows,
                           const std::map<std::string, std::string>& versions,
                           const std::filesystem::path& folder);

/// kind.json, what the study's kind says of its rows; nothing where it says nothing.
/// Errors: cannot_write.
Result<void> write_answer(const StudyRows& rows, const std::filesystem::path& folder);

/// ro-crate-metadata.json: the folder as a process run crate (RO-Crate 1.1): program, inputs,
/// results. Errors: cannot_write.
Result<void> write_ro_crate(const StudyPlan& plan,
                            const std::map<std::string, std::string>& versions,
                            const std::filesystem::path& folder);

}  // namespace flexspline::studies
