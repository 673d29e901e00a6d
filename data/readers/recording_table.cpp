#include "readers/recording_table.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "readers/cell_text.hpp"
#include "readers/csv_table.hpp"
#include "readers/plausible.hpp"
#include "readers/recording_checks.hpp"

namespace flexspline::data {
namespace {

constexpr std::size_t kMostNamed = 8;

void note_ignored(const CsvTable& table, const std::vector<Channel>& channels,
                  const std::string& file, std::vector<Finding>& notes) {
  std::string names;
  std::size_t ignored = 0;
  for (const std::string& column : table.header) {
    if (std::ranges::find(channels, column, &Channel::column) != channels.end()) continue;
    if (++ignored <= kMostNamed) names += (names.empty() ? "'" : ", '") + shown(column) + "'";
  }
  if (ignored == 0) return;
  if (ignored > kMostNamed) names += fmt::format(" and {} more", ignored - kMostNamed);
  notes.push_back({file, 1, 1, fmt::format("ignored: column {}", names),
                   "name it in [channels] to have it read"});
}

CsvRole role_of(Quantity quantity) {
  switch (quantity) {
    case Quantity::time:
      return CsvRole::increasing;
    case Quantity::valid:
      return CsvRole::valid;
    case Quantity::drive_enabled:
      return CsvRole::flag;
    default:
      return CsvRole::value;
  }
}

CsvColumn column_of(const Channel& channel) {
  const PlausibleRange range = plausible_range(channel.unit.dimension);
  const auto [low, high] =
      std::minmax({from_si(channel.unit, range.low), from_si(channel.unit, range.high)});
  return {channel.column,
          role_of(channel.quantity),
          low,
          high,
          plausible_words(channel.unit.dimension),
          fmt::format("which line {} of dataset.toml names as the {}", channel.line,
                      name_of(channel.quantity))};
}

void add_channel(Recording& recording, const Channel& channel, std::vector<double> values) {
  for (double& value : values) value = to_si(channel.unit, value);
  if (channel.quantity == Quantity::time) {
    recording.time = std::move(values);
  } else {
    recording.channels[channel.quantity] = std::move(values);
  }
}

}  // namespace

Recording read_table(const RecordingEntry& entry, Rig rig, const std::vector<Channel>& channels,
                     DatasetReading& reading) {
  Recording recording = entry.recording;
  const std::string file = entry.table.string();
  std::vector<CsvColumn> wanted;
  std::ranges::transform(channels, std::back_inserter(wanted), column_of);
  CsvTable table = read_csv(entry.table, wanted, reading);
  if (table.header.empty()) return recording;
  note_ignored(table, channels, file, reading.notes);
  if (!reading.errors.empty()) return recording;
  for (std::size_t i = 0; i < channels.size(); ++i) {
    add_channel(recording, channels[i], std::move(table.columns[i]));
  }
  check_recording(recording, rig, channels, file, reading);
  return recording;
}

}  // namespace flexspline::data
