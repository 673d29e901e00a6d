#include "import/column_words.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <vector>

namespace flexspline::data {
namespace {

using enum ColumnKind;

/// A word of a name; `part`: of a longer word, too (Motorwinkel).
struct Word {
  std::string_view text;
  ColumnKind kind;
  bool part;
};

// Where several fit, the first counts: a Torsionsmoment is a moment.
constexpr Word kKinds[] = {
    {"torque", torque, true},
    {"drehmoment", torque, true},
    {"moment", torque, true},
    {"tau", torque, false},
    {"trq", torque, true},
    {"tq", torque, false},
    {"mz", torque, false},
    {"md", torque, false},
    {"effort", torque, false},
    {"time", time, false},
    {"zeit", time, true},
    {"timestamp", time, false},
    {"timestamps", time, false},
    {"stamp", time, false},
    {"datetime", time, false},
    {"uhrzeit", time, false},
    {"t", time, false},
    {"elapsed", time, false},
    {"current", current, true},
    {"strom", current, true},
    {"iq", current, false},
    {"curr", current, false},
    {"i", current, false},
    {"duty", duty_cycle, true},
    {"pwm", duty_cycle, false},
    {"voltage", voltage, true},
    {"spannung", voltage, true},
    {"ubat", voltage, false},
    {"vbus", voltage, false},
    {"supply", voltage, false},
    {"temperature", temperature, true},
    {"temperatur", temperature, true},
    {"temp", temperature, false},
    {"velocity", velocity, true},
    {"speed", velocity, true},
    {"drehzahl", velocity, true},
    {"geschwindigkeit", velocity, true},
    {"omega", velocity, false},
    {"vel", velocity, false},
    {"dtheta", velocity, false},
    {"dq", velocity, false},
    {"qd", velocity, false},
    {"rpm", velocity, false},
    {"torsion", torsion, true},
    {"verdreh", torsion, true},
    {"twist", torsion, false},
    {"windup", torsion, false},
    {"angle", angle, true},
    {"winkel", angle, true},
    {"theta", angle, false},
    {"phi", angle, false},
    {"position", angle, true},
    {"pos", angle, false},
    {"encoder", angle, true},
    {"enc", angle, false},
    {"q", angle, false},
    {"alpha", angle, false},
    {"lage", angle, false},
    {"rotation", angle, false},
    {"displacement", displacement, true},
    {"disp", displacement, false},
    {"weg", displacement, false},
    {"stroke", displacement, false},
    {"verschiebung", displacement, true},
    {"force", force, true},
    {"kraft", force, true},
    {"enabled", enabled, false},
    {"enable", enabled, false},
    {"freigabe", enabled, true},
    {"valid", valid, false},
    {"gueltig", valid, true},
    {"ok", valid, false},
};

struct SideWord {
  std::string_view text;
  ColumnSide side;
  bool part;
};

// A single letter counts beside a kind alone: theta_m.
constexpr SideWord kSides[] = {
    {"motor", ColumnSide::motor, true},       {"mot", ColumnSide::motor, false},
    {"rotor", ColumnSide::motor, true},       {"antrieb", ColumnSide::motor, true},
    {"input", ColumnSide::motor, false},      {"wavegenerator", ColumnSide::motor, false},
    {"wg", ColumnSide::motor, false},         {"eingang", ColumnSide::motor, true},
    {"m", ColumnSide::motor, false},          {"load", ColumnSide::load, false},
    {"last", ColumnSide::load, true},         {"abtrieb", ColumnSide::load, true},
    {"output", ColumnSide::load, false},      {"out", ColumnSide::load, false},
    {"link", ColumnSide::load, false},        {"ausgang", ColumnSide::load, true},
    {"arm", ColumnSide::load, false},         {"joint", ColumnSide::load, false},
    {"gelenk", ColumnSide::load, true},       {"l", ColumnSide::load, false},
    {"transmitted", ColumnSide::load, false},
};

constexpr std::array<std::string_view, 11> kCommanded = {
    "soll",     "cmd",     "command", "commanded", "ref",     "reference",
    "setpoint", "desired", "target",  "demand",    "sollwert"};

/// Small letters and digits, words apart: "MotorPos_deg", "Motor-Winkel" -> motor pos deg, ...
std::vector<std::string> words_of(std::string_view name) {
  static constexpr std::pair<std::string_view, std::string_view> letters[] = {
      {"ä", "ae"},    {"ö", "oe"},    {"ü", "ue"},      {"Ä", "ae"},      {"Ö", "oe"},
      {"Ü", "ue"},    {"ß", "ss"},    {"θ", " theta "}, {"Θ", " theta "}, {"τ", " tau "},
      {"φ", " phi "}, {"ϕ", " phi "}, {"ω", " omega "}};
  std::string text(name);
  for (const auto& [from, to] : letters) {
    for (auto at = text.find(from); at != text.npos; at = text.find(from, at + to.size())) {
      text.replace(at, from.size(), to);
    }
  }
  std::vector<std::string> words(1);
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto letter = static_cast<unsigned char>(text[i]);
    const auto before = static_cast<unsigned char>(i > 0 ? text[i - 1] : ' ');
    const bool hump = std::isupper(letter) && std::islower(before);
    const bool index = std::isdigit(letter) && !std::isdigit(before);
    if ((!std::isalnum(letter) || hump || index) && !words.back().empty()) words.emplace_back();
    if (std::isalnum(letter)) words.back() += static_cast<char>(std::tolower(letter));
  }
  if (words.back().empty()) words.pop_back();
  return words;
}

template <class Row>
bool fits(const Row& row, const std::string& word) {
  return row.part ? word.find(row.text) != word.npos : word == row.text;
}

}  // namespace

ColumnMeaning meaning_of_name(std::string_view name) {
  const std::vector<std::string> words = words_of(name);
  ColumnMeaning meaning;
  for (const Word& row : kKinds) {
    if (meaning.kind != unknown) break;
    const bool found =
        std::ranges::any_of(words, [&](const auto& word) { return fits(row, word); });
    if (found && !(row.text == "t" && words.size() > 1 && words[0] != "t")) meaning.kind = row.kind;
  }
  for (const SideWord& row : kSides) {
    if (meaning.side != ColumnSide::unknown) break;
    const bool letter = row.text.size() == 1;
    if (letter && (meaning.kind == unknown || words.size() < 2)) continue;
    if (std::ranges::any_of(words, [&](const auto& word) { return fits(row, word); })) {
      meaning.side = row.side;
    }
  }
  meaning.commanded = std::ranges::any_of(words, [](const std::string& word) {
    return std::ranges::find(kCommanded, word) != kCommanded.end() || word.starts_with("soll");
  });
  return meaning;
}

std::string_view name_of(ColumnKind kind) {
  static constexpr std::array<std::string_view, 14> names = {
      "unknown", "time",    "angle",      "torsion", "displacement", "velocity", "torque",
      "force",   "current", "duty cycle", "voltage", "temperature",  "enabled",  "valid"};
  return names.at(static_cast<std::size_t>(kind));
}

bool may_have(ColumnKind kind, Dimension dimension) {
  switch (kind) {
    case unknown:
      return true;
    case angle:
    case torsion:
      return dimension == Dimension::angle;
    case velocity:
      return dimension == Dimension::angular_velocity || dimension == Dimension::velocity;
    case displacement:
      return dimension == Dimension::length;
    case duty_cycle:
    case enabled:
    case valid:
      return dimension == Dimension::dimensionless;
    default:
      return kind_of(dimension) == kind;
  }
}

ColumnKind kind_of(Dimension dimension) {
  switch (dimension) {
    case Dimension::time:
      return time;
    case Dimension::angle:
      return angle;
    case Dimension::length:
      return displacement;
    case Dimension::angular_velocity:
    case Dimension::velocity:
      return velocity;
    case Dimension::torque:
      return torque;
    case Dimension::force:
      return force;
    case Dimension::current:
      return current;
    case Dimension::voltage:
      return voltage;
    case Dimension::temperature:
      return temperature;
    default:
      return unknown;
  }
}

}  // namespace flexspline::data
