#include "tables/ros_definition.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>

#include <fmt/format.h>

namespace flexspline::data {
namespace {

constexpr std::size_t kMostFields = 4096;
constexpr std::size_t kDeepest = 16;

struct Plain {
  std::string_view name;
  RosKind kind;
};
constexpr std::array<Plain, 14> kPlain = {{{"bool", RosKind::boolean},
                                           {"byte", RosKind::u8},
                                           {"char", RosKind::u8},
                                           {"int8", RosKind::i8},
                                           {"uint8", RosKind::u8},
                                           {"int16", RosKind::i16},
                                           {"uint16", RosKind::u16},
                                           {"int32", RosKind::i32},
                                           {"uint32", RosKind::u32},
                                           {"int64", RosKind::i64},
                                           {"uint64", RosKind::u64},
                                           {"float32", RosKind::f32},
                                           {"float64", RosKind::f64},
                                           {"string", RosKind::text}}};

tl::unexpected<Error> no_field(std::string_view line) {
  return failure(ErrorCode::bad_data,
                 fmt::format("'{}' in the definition of a message is no field that is read",
                             line.substr(0, 80)));
}

std::string_view next_word(std::string_view& line) {
  const auto first = line.find_first_not_of(" \t\r");
  if (first == line.npos) return line = {};
  line.remove_prefix(first);
  const auto end = std::min(line.find_first_of(" \t\r"), line.size());
  const std::string_view word = line.substr(0, end);
  line.remove_prefix(end);
  return word;
}

/// Takes "[3]", "[]" or "[<=3]" off a type.
bool take_array(std::string_view& type, RosField& field) {
  const auto open = type.find('[');
  if (open == type.npos) return true;
  const std::string_view inside = type.substr(open + 1, type.size() - open - 2);
  if (!type.ends_with(']')) return false;
  type = type.substr(0, open);
  field.many = true;
  if (inside.empty() || inside.starts_with("<=")) return true;
  const auto [end, code] =
      std::from_chars(inside.data(), inside.data() + inside.size(), field.fixed);
  return code == std::errc{} && end == inside.data() + inside.size() && field.fixed > 0;
}

void take_type(std::string_view type, std::string_view package, RosField& field) {
  if (const auto bound = type.find("<="); bound != type.npos) type = type.substr(0, bound);
  const auto plain = std::ranges::find(kPlain, type, &Plain::name);
  if (plain != kPlain.end()) {
    field.kind = plain->kind;
    return;
  }
  field.kind = RosKind::message;
  field.type = type == "Header" ? "std_msgs/Header"
               : type == "time" || type == "duration"
                   ? fmt::format("builtin_interfaces/{}", type == "time" ? "Time" : "Duration")
               : type.find('/') == type.npos ? fmt::format("{}/{}", package, type)
                                             : short_ros_name(type);
}

/// A field; nothing for a comment, a constant or an empty line.
Result<std::optional<RosField>> field_of(std::string_view line, std::string_view package) {
  const std::string_view whole = line;
  line = line.substr(0, line.find('#'));
  std::string_view type = next_word(line);
  if (type.empty()) return std::nullopt;
  const std::string_view name = next_word(line);
  const auto rest = line.find_first_not_of(" \t\r");
  const bool constant = name.find('=') != name.npos || (rest != line.npos && line[rest] == '=');
  if (constant) return std::nullopt;
  RosField field;
  field.name = name;
  if (name.empty() || type.starts_with("wstring") || !take_array(type, field)) {
    return no_field(whole);
  }
  take_type(type, package, field);
  return field;
}

/// Time and duration stand in every ROS; definitions leave them out.
void add_built_in(RosDefinition& all) {
  const auto two = [](const char* first, RosKind kind, const char* second) {
    return std::vector<RosField>{{first, kind, {}, false, 0}, {second, RosKind::u32, {}, false, 0}};
  };
  all.messages.try_emplace("builtin_interfaces/Time", two("sec", RosKind::i32, "nanosec"));
  all.messages.try_emplace("builtin_interfaces/Duration", two("sec", RosKind::i32, "nanosec"));
}

/// Every message in a message is defined, none lies in itself, and none too deep.
class Nesting {
 public:
  explicit Nesting(const RosDefinition& all) : all_(all) {}

  /// How deep messages lie in this one. Each is looked at once.
  Result<std::size_t> depth(const std::string& name) {
    const auto found = all_.messages.find(name);
    if (found == all_.messages.end()) {
      return failure(ErrorCode::bad_data, fmt::format("message '{}' is not defined", name));
    }
    const auto [known, first] = depth_.try_emplace(name, kDeepest);
    if (!first) return within(known->second, name);
    std::size_t deepest = 0;
    for (const RosField& field : found->second) {
      if (field.kind != RosKind::message) continue;
      const auto inner = depth(field.type);
      if (!inner) return inner;
      deepest = std::max(deepest, *inner + 1);
    }
    depth_[name] = deepest;
    return within(deepest, name);
  }

 private:
  static Result<std::size_t> within(std::size_t depth, const std::string& name) {
    if (depth < kDeepest) return depth;
    return failure(ErrorCode::bad_data,
                   fmt::format("message '{}' lies in itself, or too deep in others", name));
  }

  const RosDefinition& all_;
  std::map<std::string, std::size_t> depth_;  ///< the deepest while it is being looked at
};

}  // namespace

std::string short_ros_name(std::string_view name) {
  const auto first = name.find('/');
  const auto last = name.rfind('/');
  if (first == name.npos) return std::string(name);
  return fmt::format("{}/{}", name.substr(0, first), name.substr(last + 1));
}

Result<RosDefinition> parse_ros_definition(std::string_view name, std::string_view text) {
  RosDefinition all;
  all.name = short_ros_name(name);
  std::string current = all.name;
  all.messages[current];
  std::size_t fields = 0;
  while (!text.empty()) {
    const auto end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line.starts_with("====")) continue;
    if (line.starts_with("MSG:")) {
      std::string_view rest = line.substr(4);
      current = short_ros_name(next_word(rest));
      all.messages[current].clear();
      continue;
    }
    auto field = field_of(line, std::string_view(current).substr(0, current.find('/')));
    if (!field) return tl::unexpected(field.error());
    if (!*field) continue;
    if (++fields > kMostFields) return failure(ErrorCode::bad_data, "a message of 4096 fields");
    all.messages[current].push_back(**std::move(field));
  }
  add_built_in(all);
  if (auto sound = Nesting(all).depth(all.name); !sound) return tl::unexpected(sound.error());
  return all;
}

}  // namespace flexspline::data
