#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

#include "flexspline/core/error.hpp"

namespace flexspline::data {

/// An artefact as it is written, without the line end: its canonical dump with "sha256" as the last
/// key.
std::string sealed(nlohmann::ordered_json content);

/// Writes an artefact: the content, whose first key is to be "schema", with "sha256" as its last
/// key, the SHA-256 of the canonical dump (indent = -1) without it. NaN and infinity become null.
/// Errors: cannot_write.
Result<void> write_artefact(const std::filesystem::path& path, nlohmann::ordered_json content);

/// JSON of a file that has been read.
/// Errors: bad_data with file, line and column, for what is not JSON.
Result<nlohmann::ordered_json> parse_json(std::string_view text, const std::filesystem::path& path);

/// The same of text that was read from there. Errors: bad_data.
Result<nlohmann::ordered_json> parse_artefact(std::string_view text,
                                              const std::filesystem::path& path,
                                              std::string_view schema);

/// The content of an artefact without its checksum.
/// Errors: input_missing when there is no such file; bad_data, naming the file, when it is not
/// JSON, has another schema, or its checksum does not hold.
Result<nlohmann::ordered_json> read_artefact(const std::filesystem::path& path,
                                             std::string_view schema);

}  // namespace flexspline::data
