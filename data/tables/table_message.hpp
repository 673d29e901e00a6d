#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "flexspline/data/table_reader.hpp"

namespace flexspline::data {

/// What a reader in a process of its own says to the one that asked.
enum class TableWord : std::uint32_t { begin = 1, rows, note, failed, done };

/// Bytes of values, one after the other.
class MessageWriter {
 public:
  void number(std::uint64_t value);
  void real(double value);
  void text(std::string_view value);
  void reals(std::span<const double> values);
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

/// The same backwards, from bytes that may be anything: nothing where they are not what is asked.
class MessageReader {
 public:
  explicit MessageReader(std::string_view bytes) : rest_(bytes) {}

  std::optional<std::uint64_t> number();
  std::optional<double> real();
  std::optional<std::string> text();
  std::optional<std::vector<double>> reals();
  bool ended() const { return rest_.empty(); }

 private:
  std::string_view rest_;
};

std::string bytes_of(const TableHead& head);
std::optional<TableHead> table_head(std::string_view bytes, const TableLimits& limits);

}  // namespace flexspline::data
