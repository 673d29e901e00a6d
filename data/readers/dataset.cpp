#include "flexspline/data/dataset.hpp"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>

#include "flexspline/core/in_parallel.hpp"
#include "flexspline/core/torsion_record.hpp"
#include "flexspline/core/write_file.hpp"
#include "readers/description.hpp"
#include "readers/recording_table.hpp"

namespace flexspline::data {
namespace {

std::filesystem::path description_of(const std::filesystem::path& folder) {
  return folder / "dataset.toml";
}

// Several at once; recordings and findings in the order of the description.
void read_tables(Description& description, DatasetReading& reading) {
  const auto& entries = description.recordings;
  std::vector<DatasetReading> found(entries.size());
  description.set.recordings.resize(entries.size());
  in_parallel(entries.size(), 0, [&](std::size_t i) {
    description.set.recordings[i] =
        read_table(entries[i], description.set.rig, description.channels, found[i]);
  });
  for (DatasetReading& one : found) {
    std::ranges::move(one.errors, std::back_inserter(reading.errors));
    std::ranges::move(one.notes, std::back_inserter(reading.notes));
    std::ranges::move(one.decisions, std::back_inserter(description.set.notes));
  }
  if (has_torque_by_inertia(description.set)) {
    description.set.notes.emplace_back(
        "no recording measures transmitted_torque: the torque across the gear is that of the "
        "load's inertia, load_inertia_kgm2 times the acceleration of load_angle");
  }
}

}  // namespace

std::string Finding::message() const {
  std::string text = file;
  if (line > 0) text += fmt::format(":{}", line);
  if (line > 0 && column > 0) text += fmt::format(":{}", column);
  text += ": " + problem;
  if (!remedy.empty()) text += "; " + remedy;
  return text;
}

DatasetReading read_dataset(const std::filesystem::path& folder) {
  DatasetReading reading;
  const Result<std::string> text = read_file(description_of(folder));
  if (!text) {
    reading.errors.push_back({description_of(folder).string(), 0, 0, text.error().problem,
                              "name a folder that holds a dataset.toml"});
    return reading;
  }
  Description description = parse_description(*text, folder, reading);
  if (description.readable) read_tables(description, reading);
  if (!reading.errors.empty()) return reading;
  reading.decisions = description.set.notes;
  description.set.sha256 = content_hash(description.set);
  reading.set = std::move(description.set);
  return reading;
}

Result<RecordingSet> load_dataset(const std::filesystem::path& folder, std::size_t most_rows) {
  std::error_code error;
  if (!std::filesystem::exists(description_of(folder), error)) {
    return failure(ErrorCode::input_missing,
                   fmt::format("no data set at {}: there is no dataset.toml", folder.string()),
                   "name a folder that holds one");
  }
  DatasetReading reading = read_dataset(folder);
  if (reading.set) {
    thin_recordings(*reading.set, most_rows);
    return *std::move(reading.set);
  }
  std::string findings;
  for (const Finding& finding : reading.errors) findings += "\n  " + finding.message();
  return failure(ErrorCode::bad_data,
                 fmt::format("data set {} cannot be used:{}", folder.string(), findings));
}

}  // namespace flexspline::data
