#pragma once

#include <filesystem>

#include <nlohmann/json_fwd.hpp>

#include "flexspline/core/error.hpp"

namespace flexspline::studies {

/// study.lock.toml as JSON. Errors: input_missing; bad_data when it is not TOML.
Result<nlohmann::json> read_lock_json(const std::filesystem::path& lock);

}  // namespace flexspline::studies
