#include "readers/description.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>

#include "flexspline/core/nearest_name.hpp"
#include "readers/description_parts.hpp"
#include "readers/rig_channels.hpp"

namespace flexspline::data {
namespace {

constexpr std::string_view kSchema = "flexspline-dataset/1";
constexpr std::array<std::string_view, 9> kKeys = {
    "schema", "name", "rig", "license", "source", "note", "constants", "channels", "recording"};
constexpr std::array<std::string_view, 6> kConstants = {"gear_ratio",        "motor_inertia_kgm2",
                                                        "load_inertia_kgm2", "load_mass_kg",
                                                        "arm_length_m",      "nominal_supply_V"};

/// False when the file is of another format, of which nothing more can be said.
bool check_schema(TomlReader& reader, const toml::table& root) {
  const auto schema = reader.required_text(root, "schema");
  if (!schema) return true;
  if (*schema == kSchema) return true;
  reader.refuse(root.get("schema")->source(), fmt::format("unknown schema '{}'", *schema),
                fmt::format("this version reads '{}'", kSchema));
  return false;
}

std::optional<Rig> parse_rig(TomlReader& reader, const toml::table& root) {
  const auto name = reader.required_text(root, "rig");
  if (!name) return std::nullopt;
  static constexpr std::array<std::string_view, 4> known = {"locked", "free", "specimen", "servo"};
  const auto rig = find_rig(*name);
  if (!rig) {
    reader.refuse(root.get("rig")->source(), fmt::format("unknown rig '{}'", *name),
                  suggestion(*name, known));
  }
  return rig;
}

std::map<std::string, double> parse_constants(TomlReader& reader, const toml::table& constants,
                                              std::vector<Finding>& notes) {
  std::map<std::string, double> values;
  for (const auto& [key, node] : constants) {
    const std::string name(key.str());
    if (const auto value = reader.finite(node, name)) values[name] = *value;
    if (std::ranges::find(kConstants, name) != kConstants.end()) continue;
    if (const auto nearest = nearest_name(name, kConstants)) {
      notes.push_back(reader.at(key.source(),
                                fmt::format("constant '{}' has no meaning here", name),
                                fmt::format("did you mean '{}'?", *nearest)));
    }
  }
  return values;
}

/// What is written but refused is not missing as well.
void check_gear_ratio(TomlReader& reader, const toml::table& root, Rig rig,
                      const std::map<std::string, double>& constants) {
  const toml::node* table = root.get("constants");
  const toml::node* written = root["constants"]["gear_ratio"].node();
  const auto ratio = constants.find("gear_ratio");
  if (ratio != constants.end() && ratio->second <= 0.0) {
    reader.refuse(written->source(),
                  fmt::format("gear_ratio is {}, which is not positive", ratio->second),
                  "give motor turns per output turn; direction belongs into the channels' signs");
  }
  if (written == nullptr && (rig == Rig::locked || rig == Rig::free)) {
    reader.refuse((table == nullptr ? root : *table).source(),
                  fmt::format("no gear_ratio, which rig '{}' needs", name_of(rig)),
                  "add gear_ratio = … below [constants]");
  }
}

void check_rig(TomlReader& reader, const toml::table& root, Rig rig, Description& description,
               bool all_channels) {
  check_gear_ratio(reader, root, rig, description.set.constants);
  description.set.display = display_units(rig, description.channels);
  // A channel that was refused is not missing as well.
  const toml::node* channels = root.get("channels");
  if (channels == nullptr || !all_channels) return;
  for (const std::string& complaint : rig_complaints(rig, description.channels)) {
    reader.refuse(channels->source(), complaint, "correct [channels]");
  }
}

std::string parse_name(TomlReader& reader, const toml::table& root,
                       const std::filesystem::path& folder, std::vector<Finding>& notes) {
  if (const auto name = reader.text(root, "name"); name && !name->empty()) return *name;
  if (!root.contains("name")) {
    notes.push_back(reader.at(root.source(), "no 'name'", "the folder's name stands for it"));
  }
  return (folder / "").lexically_normal().parent_path().filename().string();
}

std::string parse_license(TomlReader& reader, const toml::table& root,
                          std::vector<Finding>& notes) {
  if (!root.contains("license")) {
    notes.push_back(reader.at(root.source(), "no 'license'", "add its SPDX id before sharing"));
  }
  return reader.text(root, "license").value_or("");
}

void read_recordings(TomlReader& reader, const toml::table& root,
                     const std::filesystem::path& folder, Description& description,
                     std::vector<Finding>& notes) {
  const bool linear = std::ranges::find(description.channels, Quantity::displacement,
                                        &Channel::quantity) != description.channels.end();
  const toml::array* list = reader.list(root, "recording");
  if (list != nullptr) {
    ParsedRecordings parsed = parse_recordings(reader, *list, folder, linear);
    description.recordings = std::move(parsed.entries);
    description.set.notes = std::move(parsed.decisions);
    std::ranges::move(parsed.notes, std::back_inserter(notes));
  }
  if (root.contains("recording") && (list == nullptr || !list->empty())) return;
  reader.refuse(root.source(), "no recording", "add [[recording]] with id and file");
}

}  // namespace

Description parse_description(std::string_view text, const std::filesystem::path& folder,
                              DatasetReading& reading) {
  Description description;
  TomlReader reader((folder / "dataset.toml").string(), reading.errors);
  const auto root = reader.parse(text);
  if (!root || !check_schema(reader, *root)) return description;
  reader.check_keys(*root, kKeys);
  RecordingSet& set = description.set;
  set.name = parse_name(reader, *root, folder, reading.notes);
  set.license = parse_license(reader, *root, reading.notes);
  set.source = reader.text(*root, "source").value_or("");
  set.note = reader.text(*root, "note").value_or("");
  if (const toml::table* constants = reader.subtable(*root, "constants")) {
    set.constants = parse_constants(reader, *constants, reading.notes);
  }
  const std::size_t errors_before = reading.errors.size();
  const toml::table* channels = reader.subtable(*root, "channels");
  if (channels != nullptr) description.channels = parse_channels(reader, *channels);
  if (!root->contains("channels")) {
    reader.refuse(root->source(), "no [channels]", "say what each column is, and its unit");
  }
  description.readable = reading.errors.size() == errors_before;
  if (const auto rig = parse_rig(reader, *root)) {
    set.rig = *rig;
    check_rig(reader, *root, *rig, description, description.readable);
  }
  read_recordings(reader, *root, folder, description, reading.notes);
  return description;
}

}  // namespace flexspline::data
