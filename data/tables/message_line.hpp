#pragma once

#include <cstddef>
#include <cstdint>

#include "tables/table_message.hpp"

namespace flexspline::data {

struct MessageHead {
  TableWord word;
  std::uint32_t unused = 0;
  std::uint64_t bytes;
};

/// One end of the socket between a reader's process and this one.
class MessageLine {
 public:
  explicit MessageLine(int end) : end_(end) {}
  MessageLine(const MessageLine&) = delete;
  MessageLine& operator=(const MessageLine&) = delete;
  ~MessageLine();

  bool send(const void* from, std::size_t count) const;

  enum class Got { all, ended, late };

  /// patience_s < 0: for as long as it takes.
  Got receive(void* to, std::size_t count, double patience_s) const;

 private:
  bool wait(double patience_s) const;

  int end_;
};

}  // namespace flexspline::data
