#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "flexspline/core/nearest_name.hpp"
#include "readers/description_parts.hpp"
#include "readers/table_path.hpp"

namespace flexspline::data {
namespace {

constexpr std::string_view kAmplitude = "amplitude_";
constexpr std::array<std::string_view, 9> kKeys = {
    "id",           "file",          "start_s",   "excitation", "split",
    "frequency_hz", "amplitude_deg", "amplitude", "note"};

void check_entry_keys(TomlReader& reader, const toml::table& entry) {
  for (const auto& [key, value] : entry) {
    if (std::ranges::find(kKeys, key.str()) != kKeys.end()) continue;
    if (key.str().starts_with(kAmplitude)) continue;
    if (const auto nearest = nearest_name(key.str(), kKeys)) {
      reader.refuse(key.source(), fmt::format("unknown key '{}' of a recording", key.str()),
                    fmt::format("did you mean '{}'?", *nearest));
    }
  }
}

/// amplitude_<unit> of an angle or a length, in SI; an amplitude of anything else (Nm, V) is for
/// readers of the file alone.
std::optional<double> amplitude(TomlReader& reader, const toml::table& entry, bool linear) {
  std::optional<double> result;
  for (const auto& [key, node] : entry) {
    if (!key.str().starts_with(kAmplitude)) continue;
    const std::string_view symbol = key.str().substr(kAmplitude.size());
    const auto unit = find_unit(symbol);
    if (!unit) {
      reader.refuse(key.source(), fmt::format("unknown unit '{}' in key '{}'", symbol, key.str()),
                    fmt::format("use one of: {}, {}", symbols_of(Dimension::angle),
                                symbols_of(Dimension::length)));
      continue;
    }
    const Dimension wanted = linear ? Dimension::length : Dimension::angle;
    if (unit->dimension != Dimension::angle && unit->dimension != Dimension::length) continue;
    if (unit->dimension != wanted) {
      reader.refuse(key.source(),
                    fmt::format("'{}' is of dimension {}, but the motion is of dimension {}",
                                key.str(), name_of(unit->dimension), name_of(wanted)),
                    fmt::format("use one of: {}", symbols_of(wanted)));
      continue;
    }
    if (const auto value = reader.finite(node, key.str())) result = to_si(*unit, *value);
  }
  return result;
}

std::optional<double> frequency(TomlReader& reader, const toml::table& entry) {
  const auto value = reader.number(entry, "frequency_hz");
  if (value && *value <= 0.0) {
    reader.refuse(entry.get("frequency_hz")->source(),
                  fmt::format("frequency_hz is {}, which is not positive", *value),
                  "leave the key out where there is no frequency");
  }
  return value;
}

Split split(TomlReader& reader, const toml::table& entry) {
  static constexpr std::array<std::string_view, 2> words = {"train", "holdout"};
  const auto word = reader.text(entry, "split");
  if (!word) return Split::unassigned;
  if (*word == "train") return Split::train;
  if (*word == "holdout") return Split::holdout;
  reader.refuse(entry.get("split")->source(), fmt::format("unknown split '{}'", *word),
                suggestion(*word, words));
  return Split::unassigned;
}

std::optional<std::filesystem::path> file(TomlReader& reader, const toml::table& entry,
                                          const std::filesystem::path& folder) {
  const auto name = reader.required_text(entry, "file");
  if (!name) return std::nullopt;
  const auto path = table_path(folder, *name);
  if (path) return *path;
  reader.refuse(entry.get("file")->source(), path.error().problem, path.error().remedy);
  return std::nullopt;
}

std::optional<RecordingEntry> parse_recording(TomlReader& reader, const toml::table& entry,
                                              const std::filesystem::path& folder, bool linear) {
  check_entry_keys(reader, entry);
  Recording recording;
  const auto id = reader.required_text(entry, "id");
  if (id && id->empty()) {
    reader.refuse(entry.get("id")->source(), "the id of a recording is empty", "name it");
  }
  recording.id = id.value_or("");
  recording.excitation = reader.text(entry, "excitation").value_or("");
  recording.start_s = reader.number(entry, "start_s").value_or(0.0);
  recording.amplitude = amplitude(reader, entry, linear);
  recording.frequency_hz = frequency(reader, entry);
  recording.split = split(reader, entry);
  const auto path = file(reader, entry, folder);
  if (!path) return std::nullopt;
  return RecordingEntry{std::move(recording), *path};
}

/// Says when a value that ought to be unique was given before, and where.
class SeenBefore {
 public:
  std::optional<int> line_of(const std::string& value, int line) {
    const auto [place, is_new] = lines_.emplace(value, line);
    return is_new ? std::nullopt : std::optional<int>(place->second);
  }

 private:
  std::map<std::string, int> lines_;
};

int line_of(const toml::node& node) { return static_cast<int>(node.source().begin.line); }

}  // namespace

std::vector<RecordingEntry> parse_recordings(TomlReader& reader, const toml::array& list,
                                             const std::filesystem::path& folder, bool linear,
                                             std::vector<Finding>& notes) {
  std::vector<RecordingEntry> entries;
  SeenBefore ids;
  SeenBefore files;
  for (const toml::node& node : list) {
    const toml::table* entry = node.as_table();
    if (entry == nullptr) {
      reader.refuse(node.source(), "a recording is not a table", "write [[recording]] above it");
      continue;
    }
    if (auto parsed = parse_recording(reader, *entry, folder, linear)) {
      entries.push_back(*std::move(parsed));
    }
    if (const toml::node* id = entry->get("id"); id != nullptr && id->is_string()) {
      const std::string name = id->value_or(std::string());
      if (const auto line = ids.line_of(name, line_of(*id))) {
        reader.refuse(
            id->source(),
            fmt::format("two recordings have the id '{}', the other on line {}", name, *line),
            "give each recording an id of its own");
      }
    }
    if (const toml::node* name = entry->get("file"); name != nullptr && name->is_string()) {
      const std::string path = name->value_or(std::string());
      if (const auto line = files.line_of(path, line_of(*name))) {
        notes.push_back(reader.at(
            name->source(), fmt::format("file '{}' is the table of line {} too", path, *line),
            "the same samples count twice, and may be fitted and held out at once"));
      }
    }
  }
  return entries;
}

}  // namespace flexspline::data
