#pragma once

#include <filesystem>
#include <vector>

#include "readers/description.hpp"
#include "readers/toml_reader.hpp"

namespace flexspline::data {

/// Every entry of [channels] that is right, in the order of the file.
std::vector<Channel> parse_channels(TomlReader& reader, const toml::table& channels);

/// The recordings of a description as far as they are right.
struct ParsedRecordings {
  std::vector<RecordingEntry> entries;
  std::vector<Finding> notes;
  std::vector<std::string> decisions;  ///< for the notes of the set: without places in the file
};

/// Every [[recording]] that is right. Keys that the format does not know are kept by the file for
/// its readers, unless they look like one that it does. Two recordings with one id are refused,
/// unless they say the same but for start_s: one table, read once, with the later start_s.
ParsedRecordings parse_recordings(TomlReader& reader, const toml::array& list,
                                  const std::filesystem::path& folder, bool linear);

}  // namespace flexspline::data
