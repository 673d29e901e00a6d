#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "flexspline/core/recording.hpp"
#include "flexspline/data/dataset.hpp"

namespace flexspline::data {

/// The unit of an encoder's counts, which needs counts_per_rev.
inline constexpr std::string_view kCounts = "counts";

/// One entry of [channels]: a column of every table, what it is, and its unit with sign, scale and
/// offset in its factor and offset: value_si = scale (sign to_si(x)) + to_si of the offset alone.
struct Channel {
  std::string column;
  Quantity quantity = Quantity::time;
  Unit unit{};
  int line = 0;
};

/// One [[recording]]: what is known of it, and where its samples are.
struct RecordingEntry {
  Recording recording;
  std::filesystem::path table;  ///< inside the folder, checked
};

/// dataset.toml as far as it is right.
struct Description {
  RecordingSet set;  ///< without recordings
  std::vector<Channel> channels;
  std::vector<RecordingEntry> recordings;
  bool readable = false;  ///< the channels are such that tables can be read by them
};

/// Errors and notes go to the reading; what could be understood comes back.
Description parse_description(std::string_view text, const std::filesystem::path& folder,
                              DatasetReading& reading);

}  // namespace flexspline::data
