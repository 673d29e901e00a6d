#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "flexspline/core/error.hpp"

namespace flexspline::data {

enum class RosKind { boolean, i8, u8, i16, u16, i32, u32, i64, u64, f32, f64, text, message };

/// A field of a ROS message.
struct RosField {
  std::string name;
  RosKind kind = RosKind::f64;
  std::string type;         ///< of a message in it, "package/Name"
  bool many = false;        ///< an array
  std::uint32_t fixed = 0;  ///< of so many; 0: of as many as each message says
};

/// A message and those in it, by their full names.
struct RosDefinition {
  std::string name;
  std::map<std::string, std::vector<RosField>> messages;
};

/// A definition as ROS 2 writes it (encoding "ros2msg"): the fields of the message, then those of
/// every message in it behind a line of = and "MSG: package/Name". name: "package/msg/Name".
/// Errors: bad_data, for a line that is no field, a message that is not defined or lies in itself,
/// and wide strings.
Result<RosDefinition> parse_ros_definition(std::string_view name, std::string_view text);

/// The published definition of a common message, where a file does not hold it: JointState, Wrench,
/// Temperature, the numbers and arrays of std_msgs. Empty where it is not known here.
std::string known_ros_definition(std::string_view name);

/// The unit that the published definition of a message states for a field; empty where it has none.
std::string_view ros_unit(std::string_view message, std::string_view field);

/// "package/Name" of "package/msg/Name".
std::string short_ros_name(std::string_view name);

}  // namespace flexspline::data
