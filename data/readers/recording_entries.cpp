#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "flexspline/core/nearest_name.hpp"
#include "readers/description_parts.hpp"
#include "readers/plausible.hpp"
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
    if (result && !(*result >= 0.0 && *result <= plausible_range(wanted).high)) {
      reader.refuse(node.source(), fmt::format("{} is {:.6g} in SI", key.str(), *result),
                    "give the half range of the motion, positive; " + plausible_words(wanted));
    }
  }
  return result;
}

std::optional<double> frequency(TomlReader& reader, const toml::table& entry) {
  const auto value = reader.number(entry, "frequency_hz");
  if (value && !(*value > 0.0 && *value <= plausible_range(Dimension::frequency).high)) {
    reader.refuse(entry.get("frequency_hz")->source(),
                  fmt::format("frequency_hz is {}, which is {}", *value,
                              *value > 0.0 ? "implausible" : "not positive"),
                  "leave the key out where there is no frequency");
  }
  return value;
}

double start(TomlReader& reader, const toml::table& entry) {
  const double value = reader.number(entry, "start_s").value_or(0.0);
  if (std::abs(value) > plausible_range(Dimension::time).high) {
    reader.refuse(entry.get("start_s")->source(), fmt::format("start_s is {}", value),
                  plausible_words(Dimension::time));
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
  recording.start_s = start(reader, entry);
  recording.amplitude = amplitude(reader, entry, linear);
  recording.frequency_hz = frequency(reader, entry);
  recording.split = split(reader, entry);
  const auto path = file(reader, entry, folder);
  if (!path) return std::nullopt;
  return RecordingEntry{std::move(recording), *path};
}

int line_of(const toml::node& node) { return static_cast<int>(node.source().begin.line); }

/// The [[recording]]s of a file one after the other, and what each repeats of those before it.
class RecordingList {
 public:
  RecordingList(TomlReader& reader, const std::filesystem::path& folder, bool linear)
      : reader_(reader), folder_(folder), linear_(linear) {}

  void add(const toml::table& entry) {
    refuse_repeated(entry, "id", entry["id"].value<std::string>().value_or(""), ids_);
    auto recording = parse_recording(reader_, entry, folder_, linear_);
    if (!recording) return;
    std::error_code ignored;
    const std::filesystem::path table = std::filesystem::canonical(recording->table, ignored);
    refuse_repeated(entry, "file", table.string(), tables_);
    entries_.push_back(*std::move(recording));
  }

  std::vector<RecordingEntry> entries() && { return std::move(entries_); }

 private:
  using Lines = std::map<std::string, int>;

  void refuse_repeated(const toml::table& entry, std::string_view key, const std::string& value,
                       Lines& before) {
    if (value.empty()) return;
    const toml::node& written = *entry.get(key);
    const auto [found, is_new] = before.try_emplace(value, line_of(written));
    if (is_new) return;
    reader_.refuse(
        written.source(),
        fmt::format("two recordings have the {} '{}', the other on line {}", key,
                    written.value<std::string>().value_or(""), found->second),
        fmt::format("give each recording {} of its own", key == "id" ? "an id" : "a file"));
  }

  TomlReader& reader_;
  const std::filesystem::path& folder_;
  bool linear_;
  std::vector<RecordingEntry> entries_;
  Lines ids_;
  Lines tables_;
};

}  // namespace

std::vector<RecordingEntry> parse_recordings(TomlReader& reader, const toml::array& list,
                                             const std::filesystem::path& folder, bool linear) {
  RecordingList recordings(reader, folder, linear);
  for (const toml::node& node : list) {
    if (const toml::table* entry = node.as_table()) {
      recordings.add(*entry);
    } else {
      reader.refuse(node.source(), "a recording is not a table", "write [[recording]] above it");
    }
  }
  return std::move(recordings).entries();
}

}  // namespace flexspline::data
