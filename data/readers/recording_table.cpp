#include "readers/recording_table.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "flexspline/core/nearest_name.hpp"
#include "flexspline/core/write_file.hpp"
#include "readers/csv_table.hpp"

namespace flexspline::data {
namespace {

constexpr std::size_t kFewestSamples = 16;

void refuse_missing(const CsvTable& table, const Channel& channel, const std::string& file,
                    std::vector<Finding>& errors) {
  const std::vector<std::string_view> header(table.header.begin(), table.header.end());
  errors.push_back({file, 1, 1,
                    fmt::format("no column '{}', which line {} of dataset.toml names as the {}",
                                channel.column, channel.line, name_of(channel.quantity)),
                    suggestion(channel.column, header)});
}

void note_ignored(const CsvTable& table, const std::vector<Channel>& channels,
                  const std::string& file, std::vector<Finding>& notes) {
  std::string names;
  for (const std::string& column : table.header) {
    if (std::ranges::find(channels, column, &Channel::column) != channels.end()) continue;
    names += (names.empty() ? "'" : ", '") + column + "'";
  }
  if (names.empty()) return;
  notes.push_back({file, 1, 1, fmt::format("ignored: column {}", names),
                   "name it in [channels] to have it read"});
}

CsvColumns wanted_columns(const std::vector<Channel>& channels) {
  CsvColumns wanted;
  for (const Channel& channel : channels) {
    wanted.names.push_back(channel.column);
    if (channel.quantity == Quantity::time) wanted.increasing = channel.column;
  }
  return wanted;
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

Recording read_table(const RecordingEntry& entry, const std::vector<Channel>& channels,
                     DatasetReading& reading) {
  Recording recording = entry.recording;
  const std::string file = entry.table.string();
  const Result<std::string> text = read_file(entry.table);
  if (!text) {
    reading.errors.push_back({file, 0, 0, text.error().problem, text.error().remedy});
    return recording;
  }
  CsvTable table = parse_csv(*text, wanted_columns(channels), file, reading);
  if (table.header.empty()) return recording;
  note_ignored(table, channels, file, reading.notes);
  for (const Channel& channel : channels) {
    const auto found = std::ranges::find(table.header, channel.column);
    if (found == table.header.end()) {
      refuse_missing(table, channel, file, reading.errors);
      continue;
    }
    const auto index = static_cast<std::size_t>(found - table.header.begin());
    add_channel(recording, channel, std::move(table.columns[index]));
  }
  if (table.rows < kFewestSamples) {
    reading.errors.push_back(
        {file, static_cast<int>(table.rows) + 1, 1,
         fmt::format("{} samples, where {} are the fewest", table.rows, kFewestSamples),
         "record for longer"});
  }
  return recording;
}

}  // namespace flexspline::data
