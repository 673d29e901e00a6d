#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tables/ros_definition.hpp"

namespace flexspline::data {

/// A number of a message: a column of the table that its topic is.
struct CdrLeaf {
  std::string name;  ///< "position.joint_1", "wrench.torque.z", "data[2]"
  std::string unit;  ///< by the definition of a common message
  bool stamp = false;
};

/// The numbers of a message in the order of its definition; a stamp is ns since 1970.
struct CdrValues {
  std::vector<double> numbers;
  std::vector<std::int64_t> stamps;  ///< beside numbers: of a stamp its ns, else 0
};

/// Reads messages as ROS 2 serialises them: CDR of the OMG, version 1, either byte order.
class CdrReader {
 public:
  CdrReader(const RosDefinition& definition, std::size_t most) : all_(definition), most_(most) {}

  /// What the numbers of a message are called. Absent where the message does not fit the
  /// definition, or holds more numbers than the most.
  std::optional<std::vector<CdrLeaf>> leaves(std::string_view bytes) const;

  /// Its numbers. Absent as above.
  bool values(std::string_view bytes, CdrValues& to) const;

 private:
  const RosDefinition& all_;
  std::size_t most_;
};

}  // namespace flexspline::data
