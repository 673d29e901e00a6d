#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "flexspline/data/table_reader.hpp"
#include "tables/mdf_blocks.hpp"

namespace flexspline::data {

/// How a raw number becomes a physical one: x, a + b x, a rational function, or a table.
struct MdfConversion {
  enum class Kind { none, linear, rational, interpolated, stepped } kind = Kind::none;
  std::vector<double> values;

  double operator()(double raw) const;
};

/// A channel of numbers in the records of a group.
struct MdfChannel {
  TableColumn column;
  bool counted = false;  ///< a virtual master: the record's index
  bool is_signed = false;
  bool is_real = false;
  bool big_endian = false;
  std::size_t byte = 0;
  unsigned bit = 0;
  unsigned bits = 0;
  std::optional<std::size_t> invalid_bit;  ///< behind the record's data
  MdfConversion conversion;

  /// NaN where the bench marked it as invalid.
  double value(std::string_view record, std::size_t data_bytes, std::uint64_t index) const;
};

/// Nothing for what holds no number: texts, byte arrays, structures; or lies beyond the record.
std::optional<MdfChannel> mdf_channel(const MdfFile& file, const MdfBlock& block,
                                      std::size_t data_bytes, std::size_t invalid_bytes);

}  // namespace flexspline::data
