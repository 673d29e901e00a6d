#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstring>
#include <iterator>
#include <set>

#include "flexspline/core/write_file.hpp"
#include "flexspline/data/dataset.hpp"
#include "flexspline/data/sanity_codes.hpp"
#include "readers/toml_text.hpp"

namespace flexspline::data {
namespace {

struct Column {
  Quantity quantity;
  Unit unit;
};

/// Those of the first recording; the format has one list for all.
Result<std::vector<Column>> columns_of(const RecordingSet& set) {
  std::vector<Column> columns = {{Quantity::time, display_unit(Quantity::time, set.display)}};
  for (const auto& [quantity, values] : set.recordings.front().channels) {
    columns.push_back({quantity, display_unit(quantity, set.display)});
  }
  for (const Recording& recording : set.recordings) {
    const bool complete = std::ranges::all_of(columns, [&recording](const Column& column) {
      const auto* series = recording.find(column.quantity);
      return series != nullptr && series->size() == recording.time.size();
    });
    if (complete && recording.channels.size() + 1 == columns.size()) continue;
    return failure(ErrorCode::bad_data,
                   fmt::format("recording '{}' does not have the channels of '{}' at full length",
                               recording.id, set.recordings.front().id),
                   "write recordings with other channels as a data set of their own");
  }
  return columns;
}

std::string table_text(const Recording& recording, const std::vector<Column>& columns) {
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  for (const Column& column : columns) {
    fmt::format_to(out, "{}{}", text.size() == 0 ? "" : ",", name_of(column.quantity));
  }
  for (std::size_t i = 0; i < recording.time.size(); ++i) {
    char separator = '\n';
    for (const Column& column : columns) {
      const double value = (*recording.find(column.quantity))[i];
      fmt::format_to(out, "{}{}", separator, from_si(column.unit, value));
      separator = ',';
    }
  }
  text.push_back('\n');
  return fmt::to_string(text);
}

/// The id as a file name: letters that a file system or a shell may stumble over become '_'.
std::string file_stem(const std::string& id, std::set<std::string>& taken) {
  std::string stem = id;
  std::ranges::replace_if(
      stem,
      [](unsigned char letter) { return !std::isalnum(letter) && !std::strchr("-_.+", letter); },
      '_');
  if (stem.starts_with('.')) stem.front() = '_';
  while (!taken.insert(stem).second) stem += "_";
  return stem;
}

std::string entry_text(const Recording& recording, const std::string& file,
                       const DisplayUnits& display) {
  std::string text =
      fmt::format("\n[[recording]]\nid = {}\nfile = {}\nstart_s = {}\n", toml_quoted(recording.id),
                  toml_quoted(file), toml_number(recording.start_s));
  if (!recording.excitation.empty()) {
    text += fmt::format("excitation = {}\n", toml_quoted(recording.excitation));
  }
  if (recording.amplitude) {
    const Unit unit = find_unit(display.motion).value_or(Unit{"rad", Dimension::angle, 1.0, 0.0});
    text += fmt::format("amplitude_{} = {}\n", unit.symbol,
                        toml_number(from_si(unit, *recording.amplitude)));
  }
  if (recording.frequency_hz) {
    text += fmt::format("frequency_hz = {}\n", toml_number(*recording.frequency_hz));
  }
  if (recording.split == Split::train) text += "split = \"train\"\n";
  if (recording.split == Split::holdout) text += "split = \"holdout\"\n";
  return text;
}

std::string accepted_text(const RecordingSet& set) {
  std::string list;
  for (const std::string_view code : accepted_findings(set)) {
    list += (list.empty() ? "" : ", ") + toml_quoted(code);
  }
  return list.empty() ? list : fmt::format("accept = [{}]\n", list);
}

std::string head_text(const RecordingSet& set, const std::vector<Column>& columns) {
  std::string text = fmt::format("schema = \"flexspline-dataset/1\"\nname = {}\nrig = \"{}\"\n",
                                 toml_quoted(set.name), name_of(set.rig));
  if (!set.license.empty()) text += fmt::format("license = {}\n", toml_quoted(set.license));
  if (!set.source.empty()) text += fmt::format("source = {}\n", toml_quoted(set.source));
  if (!set.note.empty()) text += fmt::format("note = {}\n", toml_quoted(set.note));
  text += accepted_text(set);
  text += "\n[constants]\n";
  for (const auto& [name, value] : set.constants) {
    text += fmt::format("{} = {}\n", toml_quoted(name), toml_number(value));
  }
  text += "\n[channels]\n";
  for (const Column& column : columns) {
    text += fmt::format("{0} = {{ quantity = \"{0}\", unit = \"{1}\" }}\n",
                        name_of(column.quantity), column.unit.symbol);
  }
  return text;
}

}  // namespace

Unit display_unit(Quantity quantity, const DisplayUnits& display) {
  const auto info = std::ranges::find(quantities(), quantity, &QuantityInfo::quantity);
  for (const std::string& symbol : {display.motion, display.effort, display.motion + "/s"}) {
    const auto unit = find_unit(symbol);
    if (!unit) continue;
    const auto& dimensions = info->dimensions;
    if (std::ranges::find(dimensions, unit->dimension) != dimensions.end()) return *unit;
  }
  const Dimension dimension = info->dimensions.front();
  const auto si = std::ranges::find_if(units(), [dimension](const Unit& unit) {
    return unit.dimension == dimension && unit.factor == 1.0 && unit.offset == 0.0;
  });
  return *si;
}

Result<void> write_dataset(const std::filesystem::path& folder, const RecordingSet& set) {
  if (set.recordings.empty()) {
    return failure(ErrorCode::bad_data, fmt::format("data set '{}' has no recording", set.name),
                   "give it one");
  }
  const auto columns = columns_of(set);
  if (!columns) return tl::unexpected<Error>(columns.error());
  std::string description = head_text(set, *columns);
  std::set<std::string> taken;
  for (const Recording& recording : set.recordings) {
    const std::string file = file_stem(recording.id, taken) + ".csv";
    auto written = write_file(folder / file, table_text(recording, *columns));
    if (!written) return written;
    description += entry_text(recording, file, set.display);
  }
  // Last, so that a folder without all its tables is no data set yet.
  return write_file(folder / "dataset.toml", description);
}

}  // namespace flexspline::data
