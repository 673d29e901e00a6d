#pragma once

#include <filesystem>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

#include "flexspline/core/error.hpp"

namespace flexspline::reports {

/// Said of an artefact whose fields do not fit its schema.
inline constexpr const char* kOtherKind =
    "a field is missing or of another kind than its schema says";

/// The JSON of an artefact. Errors, without the file's name: input_missing; bad_data when it is not
/// JSON, has another schema, or its checksum does not hold.
Result<nlohmann::json> read_checked(const std::filesystem::path& path, std::string_view schema);

/// The same of its text.
Result<nlohmann::json> check_text(const std::string& text, std::string_view schema);

}  // namespace flexspline::reports
