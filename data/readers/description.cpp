#include "readers/description.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>

#include "flexspline/core/nearest_name.hpp"
#include "flexspline/data/sanity_codes.hpp"
#include "readers/description_parts.hpp"
#include "readers/rig_channels.hpp"

namespace flexspline::data {
namespace {

constexpr std::string_view kSchema = "flexspline-dataset/1";
constexpr std::array<std::string_view, 10> kKeys = {"schema",   "name",     "rig",    "license",
                                                    "source",   "note",     "accept", "constants",
                                                    "channels", "recording"};
/// A constant that has a meaning, and what it may be: positive, and no more than this.
struct KnownConstant {
  std::string_view name;
  double most;
  std::string_view says;
};

constexpr std::array<KnownConstant, 6> kConstants = {{
    {"gear_ratio", 1e6,
     "give motor turns per output turn; direction belongs into the channels' signs"},
    {"motor_inertia_kgm2", 1e6, "give kg m2 at the motor's shaft, or leave it out"},
    {"load_inertia_kgm2", 1e9, "give kg m2 at the output, or leave it out"},
    {"load_mass_kg", 1e7, "give kg, or leave it out"},
    {"arm_length_m", 1e4, "give m, or leave it out"},
    {"nominal_supply_V", 1e6, "give V, or leave it out"},
}};

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

void check_constant(TomlReader& reader, const toml::node& node, const KnownConstant& known,
                    double value) {
  if (value > 0.0 && value <= known.most) return;
  reader.refuse(node.source(),
                fmt::format("{} is {}, which is {}", known.name, value,
                            value > 0.0 ? fmt::format("implausible (at most {:g})", known.most)
                                        : "not positive"),
                std::string(known.says));
}

std::map<std::string, double> parse_constants(TomlReader& reader, const toml::table& constants,
                                              std::vector<Finding>& notes) {
  std::vector<std::string_view> names;
  for (const KnownConstant& known : kConstants) names.push_back(known.name);
  std::map<std::string, double> values;
  for (const auto& [key, node] : constants) {
    const std::string name(key.str());
    const auto value = reader.finite(node, name);
    if (value) values[name] = *value;
    const auto* known = std::ranges::find(kConstants, name, &KnownConstant::name);
    if (known != kConstants.end()) {
      if (value) check_constant(reader, node, *known, *value);
    } else if (const auto nearest = nearest_name(name, names)) {
      notes.push_back(reader.at(key.source(),
                                fmt::format("constant '{}' has no meaning here", name),
                                fmt::format("did you mean '{}'?", *nearest)));
    }
  }
  return values;
}

/// What is written but refused is not missing as well.
void check_gear_ratio(TomlReader& reader, const toml::table& root, Rig rig) {
  const toml::node* table = root.get("constants");
  const toml::node* written = root["constants"]["gear_ratio"].node();
  if (written != nullptr || (rig != Rig::locked && rig != Rig::free)) return;
  reader.refuse((table == nullptr ? root : *table).source(),
                fmt::format("no gear_ratio, which rig '{}' needs", name_of(rig)),
                "add gear_ratio = … below [constants]");
}

void check_rig(TomlReader& reader, const toml::table& root, Rig rig, Description& description,
               bool all_channels) {
  check_gear_ratio(reader, root, rig);
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
    notes.push_back(reader.at(root.source(), "no 'name'", "the folder's name is used"));
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

void read_accepted(TomlReader& reader, const toml::table& root, RecordingSet& set) {
  const toml::array* list = reader.list(root, "accept");
  if (list == nullptr) return;
  for (const toml::node& node : *list) {
    const std::string code = node.value<std::string>().value_or("");
    if (is_sanity_code(code)) {
      accept_finding(set, code);
    } else {
      reader.refuse(node.source(), fmt::format("accept: there is no finding '{}'", code),
                    sanity_code_suggestion(code));
    }
  }
}

void read_recordings(TomlReader& reader, const toml::table& root,
                     const std::filesystem::path& folder, Description& description) {
  const bool linear = std::ranges::find(description.channels, Quantity::displacement,
                                        &Channel::quantity) != description.channels.end();
  const toml::array* list = reader.list(root, "recording");
  if (list != nullptr) {
    description.recordings = parse_recordings(reader, *list, folder, linear);
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
  read_accepted(reader, *root, set);
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
  read_recordings(reader, *root, folder, description);
  return description;
}

}  // namespace flexspline::data
