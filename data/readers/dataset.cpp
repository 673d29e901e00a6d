#include "flexspline/data/dataset.hpp"

#include <fmt/format.h>

#include "flexspline/core/write_file.hpp"
#include "readers/description.hpp"
#include "readers/recording_table.hpp"

namespace flexspline::data {
namespace {

std::filesystem::path description_of(const std::filesystem::path& folder) {
  return folder / "dataset.toml";
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
  if (description.readable) {
    for (const RecordingEntry& entry : description.recordings) {
      description.set.recordings.push_back(read_table(entry, description.channels, reading));
    }
  }
  if (!reading.errors.empty()) return reading;
  description.set.sha256 = content_hash(description.set);
  reading.set = std::move(description.set);
  return reading;
}

Result<RecordingSet> load_dataset(const std::filesystem::path& folder) {
  std::error_code error;
  if (!std::filesystem::exists(description_of(folder), error)) {
    return failure(ErrorCode::input_missing,
                   fmt::format("no data set at {}: there is no dataset.toml", folder.string()),
                   "name a folder that holds one");
  }
  DatasetReading reading = read_dataset(folder);
  if (reading.set) return *std::move(reading.set);
  std::string findings;
  for (const Finding& finding : reading.errors) findings += "\n  " + finding.message();
  return failure(ErrorCode::bad_data,
                 fmt::format("data set {} cannot be used:{}", folder.string(), findings));
}

}  // namespace flexspline::data
