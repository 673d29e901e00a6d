#pragma once

#include <string_view>

#include <nlohmann/json_fwd.hpp>

#include "flexspline/core/error.hpp"
#include "flexspline/studies/case_row.hpp"

namespace flexspline::studies {

/// A row as it is kept beside its case: NaN is null.
nlohmann::ordered_json row_json(const CaseRow& row);

/// Errors: bad_data for what is no row.
Result<CaseRow> row_from_json(std::string_view text);

}  // namespace flexspline::studies
