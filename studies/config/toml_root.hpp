#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "config/toml_section.hpp"
#include "flexspline/core/error.hpp"

namespace flexspline::studies {

/// Reads a TOML file by its root section. Gives what is wrong, in the order of the file; text that
/// is not TOML is one finding, and `read` is not called.
/// Errors: input_missing when the file cannot be read.
Result<std::vector<data::Finding>> read_toml_root(const std::filesystem::path& file,
                                                  const std::function<void(TomlSection&)>& read);

/// The same of text that was read from there.
std::vector<data::Finding> read_toml_text(const std::string& text,
                                          const std::filesystem::path& file,
                                          const std::function<void(TomlSection&)>& read);

/// Refuses any other schema than this one.
void check_schema(TomlSection& root, std::string_view schema);

/// The findings as one error of bad data.
Error as_error(const std::vector<data::Finding>& findings);

}  // namespace flexspline::studies
