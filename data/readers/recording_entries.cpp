#include <fmt/format.h>

#include <algorithm>
#include <array>

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

int line_of(const toml::node& node) { return static_cast<int>(node.source().begin.line); }

std::string text_of(const toml::table& entry, std::string_view key) {
  return entry[key].value<std::string>().value_or("");
}

double start_of(const toml::table& entry) { return entry["start_s"].value_or(0.0); }

/// One table listed for two passes over the same excitation: all is said twice, but for start_s.
bool is_other_pass(const toml::table& one, const toml::table& other) {
  toml::table left = one;
  toml::table right = other;
  left.erase("start_s");
  right.erase("start_s");
  return left == right && start_of(one) != start_of(other);
}

/// The [[recording]]s of a file one after the other, and what each repeats of those before it.
class RecordingList {
 public:
  RecordingList(TomlReader& reader, const std::filesystem::path& folder, bool linear,
                ParsedRecordings& parsed)
      : reader_(reader), folder_(folder), linear_(linear), parsed_(parsed) {}

  void add(const toml::table& entry) {
    const toml::table* before = first_with("id", entry);
    if (before != nullptr && is_other_pass(*before, entry)) {
      merge(*before, entry);
      return;
    }
    if (before != nullptr) refuse_id(*before, entry);
    if (const toml::table* same = first_with("file", entry)) note_file(*same, entry);
    seen_.push_back(&entry);
    auto recording = parse_recording(reader_, entry, folder_, linear_);
    if (recording) parsed_.entries.push_back(*std::move(recording));
  }

 private:
  const toml::table* first_with(std::string_view key, const toml::table& entry) const {
    const std::string value = text_of(entry, key);
    const auto found = std::ranges::find_if(
        seen_, [&](const toml::table* other) { return text_of(*other, key) == value; });
    return value.empty() || found == seen_.end() ? nullptr : *found;
  }

  /// Both passes went into the one table, where the later has overwritten the earlier.
  void merge(const toml::table& before, const toml::table& entry) {
    const std::string id = text_of(entry, "id");
    const auto found = std::ranges::find(
        parsed_.entries, id, [](const RecordingEntry& parsed) { return parsed.recording.id; });
    if (found == parsed_.entries.end()) return;  // refused already
    double& start = found->recording.start_s;
    const double listed = reader_.number(entry, "start_s").value_or(0.0);
    const std::string says = fmt::format(
        "recording '{}' is listed for passes at {} s and {} s with one file: it is read once, as "
        "of the later",
        id, start, listed);
    start = std::max(start, listed);
    parsed_.decisions.push_back(says);
    parsed_.notes.push_back(reader_.at(
        entry.get("id")->source(), fmt::format("{} (the other on line {})", says, line_of(before)),
        "give each pass an id and a file of its own"));
  }

  void refuse_id(const toml::table& before, const toml::table& entry) {
    const toml::node& id = *entry.get("id");
    reader_.refuse(id.source(),
                   fmt::format("two recordings have the id '{}', the other on line {}",
                               text_of(entry, "id"), line_of(*before.get("id"))),
                   "give each recording an id of its own");
  }

  void note_file(const toml::table& before, const toml::table& entry) {
    const toml::node& file = *entry.get("file");
    parsed_.notes.push_back(
        reader_.at(file.source(),
                   fmt::format("file '{}' is the table of line {} too", text_of(entry, "file"),
                               line_of(*before.get("file"))),
                   "the same samples count twice, and may be fitted and held out at once"));
  }

  TomlReader& reader_;
  const std::filesystem::path& folder_;
  bool linear_;
  ParsedRecordings& parsed_;
  std::vector<const toml::table*> seen_;
};

}  // namespace

ParsedRecordings parse_recordings(TomlReader& reader, const toml::array& list,
                                  const std::filesystem::path& folder, bool linear) {
  ParsedRecordings parsed;
  RecordingList recordings(reader, folder, linear, parsed);
  for (const toml::node& node : list) {
    if (const toml::table* entry = node.as_table()) {
      recordings.add(*entry);
    } else {
      reader.refuse(node.source(), "a recording is not a table", "write [[recording]] above it");
    }
  }
  return parsed;
}

}  // namespace flexspline::data
