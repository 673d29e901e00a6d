#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "flexspline/data/table_reader.hpp"

namespace flexspline::data {

/// A topic of a bag: messages of one type.
struct BagTopic {
  std::string name;
  std::string type;           ///< "sensor_msgs/msg/JointState"
  std::string definition;     ///< as the bag holds it, or empty
  std::string serialisation;  ///< "cdr" is read
  std::int64_t id = 0;        ///< in the bag
};

/// ns since 1970 when it was logged, and its bytes. False: no more are wanted.
using BagMessage = std::function<bool(std::int64_t, std::string_view)>;

/// What holds messages by topic.
class Bag {
 public:
  virtual ~Bag() = default;
  virtual const std::vector<BagTopic>& topics() const = 0;
  /// Every message of a topic, in the order of the file. Errors: bad_data.
  virtual Result<void> messages(const BagTopic& topic, const BagMessage& take) = 0;
};

/// Each topic whose messages hold numbers, as a table of its name: its clock is the stamp of the
/// message's header where it has one, else the time when it was logged. Messages of another shape
/// than the first are left out and counted. Errors: bad_data, of the bag; where no topic can be
/// read.
Result<void> tell_bag(Bag& bag, const TableLimits& limits, TableSink& sink);

}  // namespace flexspline::data
