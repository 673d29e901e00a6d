#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "flexspline/core/drive_spec.hpp"
#include "flexspline/core/error.hpp"
#include "flexspline/core/model_spec.hpp"

namespace flexspline::data {

/// A model as text of a MODEL.toml, schema "flexspline-model/1" (docs/model-file.md). Numbers read
/// back to the same bits.
std::string model_toml(const ModelSpec& model);

/// The same with the table [rig]: the bench and its constants.
std::string model_toml(const RigModel& model);

/// Reads the text of a MODEL.toml; file names it in messages.
/// Errors: bad_data with every finding at once, by file, line and column: unknown or missing keys,
/// laws and effects that do not exist, numbers that do not fit them. Without [h], h = 1.
Result<ModelSpec> parse_model(std::string_view text, const std::string& file);

/// The same with its table [rig]; without one, a specimen.
Result<RigModel> parse_rig_model(std::string_view text, const std::string& file);

/// Errors: cannot_write.
Result<void> write_model(const std::filesystem::path& path, const ModelSpec& model);
Result<void> write_model(const std::filesystem::path& path, const RigModel& model);

/// Errors: input_missing, and those of parse_model.
Result<ModelSpec> read_model(const std::filesystem::path& path);
Result<RigModel> read_rig_model(const std::filesystem::path& path);

}  // namespace flexspline::data
