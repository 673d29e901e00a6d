#pragma once

#include <filesystem>
#include <vector>

#include "readers/description.hpp"
#include "readers/toml_reader.hpp"

namespace flexspline::data {

/// Every entry of [channels] that is right, in the order of the file.
std::vector<Channel> parse_channels(TomlReader& reader, const toml::table& channels);

/// Every [[recording]] that is right. Keys that the format does not know are kept by the file for
/// its readers, unless they look like one that it does. Two recordings with one id or one file are
/// refused.
std::vector<RecordingEntry> parse_recordings(TomlReader& reader, const toml::array& list,
                                             const std::filesystem::path& folder, bool linear);

}  // namespace flexspline::data
