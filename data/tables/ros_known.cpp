#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "tables/ros_definition.hpp"

namespace flexspline::data {
namespace {

struct Known {
  std::string_view name;
  std::string_view text;
};

constexpr const char* kHeader =
    "MSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n";
constexpr const char* kWrench =
    "MSG: geometry_msgs/Wrench\nVector3 force\nVector3 torque\n"
    "MSG: geometry_msgs/Vector3\nfloat64 x\nfloat64 y\nfloat64 z\n";
constexpr const char* kLayout =
    "MSG: std_msgs/MultiArrayLayout\nMultiArrayDimension[] dim\nuint32 data_offset\n"
    "MSG: std_msgs/MultiArrayDimension\nstring label\nuint32 size\nuint32 stride\n";

/// As the packages of ROS 2 publish them (Humble to Jazzy).
constexpr std::array<Known, 5> kKnown = {{
    {"sensor_msgs/JointState",
     "std_msgs/Header header\nstring[] name\nfloat64[] position\nfloat64[] velocity\n"
     "float64[]\teffort\n"},
    {"sensor_msgs/Temperature", "std_msgs/Header header\nfloat64 temperature\nfloat64 variance\n"},
    {"geometry_msgs/WrenchStamped", "std_msgs/Header header\nWrench wrench\n"},
    {"geometry_msgs/Wrench", "Vector3 force\nVector3 torque\n"},
    {"std_msgs/Header", "builtin_interfaces/Time stamp\nstring frame_id\n"},
}};

struct Stated {
  std::string_view message, field, unit;
};
constexpr std::array<Stated, 7> kUnits = {{{"sensor_msgs/JointState", "position", "rad"},
                                           {"sensor_msgs/JointState", "velocity", "rad/s"},
                                           {"sensor_msgs/JointState", "effort", "Nm"},
                                           {"sensor_msgs/Temperature", "temperature", "degC"},
                                           {"geometry_msgs/Wrench", "force", "N"},
                                           {"geometry_msgs/Wrench", "torque", "Nm"},
                                           {"std_msgs/Header", "stamp", "s"}}};

constexpr std::array<Known, 11> kNumbers = {{{"Bool", "bool"},
                                             {"Float32", "float32"},
                                             {"Float64", "float64"},
                                             {"Int8", "int8"},
                                             {"UInt8", "uint8"},
                                             {"Int16", "int16"},
                                             {"UInt16", "uint16"},
                                             {"Int32", "int32"},
                                             {"UInt32", "uint32"},
                                             {"Int64", "int64"},
                                             {"UInt64", "uint64"}}};

}  // namespace

std::string known_ros_definition(std::string_view given) {
  const std::string name = short_ros_name(given);
  const auto found = std::ranges::find(kKnown, name, &Known::name);
  if (found != kKnown.end()) return fmt::format("{}{}{}", found->text, kHeader, kWrench);
  for (const auto& [word, type] : kNumbers) {
    if (name == fmt::format("std_msgs/{}", word)) return fmt::format("{} data\n", type);
    if (name != fmt::format("std_msgs/{}MultiArray", word)) continue;
    return fmt::format("MultiArrayLayout layout\n{}[] data\n{}", type, kLayout);
  }
  return {};
}

std::string_view ros_unit(std::string_view message, std::string_view field) {
  for (const Stated& one : kUnits) {
    if (one.message == message && one.field == field) return one.unit;
  }
  return {};
}

}  // namespace flexspline::data
