#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "tables/mdf_blocks.hpp"

namespace flexspline::data {

/// The records' bytes of a data group, one after the other, whatever blocks they lie in: plain,
/// listed, deflated, deflated and transposed.
class MdfData {
 public:
  /// Errors: bad_data, for a list that goes round in a circle or leads out of the file.
  static Result<MdfData> open(const MdfFile& file, std::uint64_t first);

  /// So many bytes; fewer at the end of the data. Errors: bad_data.
  Result<std::size_t> read(char* to, std::size_t count);

 private:
  explicit MdfData(const MdfFile& file) : file_(file) {}
  Result<void> list(std::uint64_t at);
  Result<bool> next_piece();
  Result<void> inflate(std::uint64_t at);

  const MdfFile& file_;
  std::vector<std::uint64_t> blocks_;  ///< DT or DZ, in their order
  std::size_t block_ = 0;
  std::string piece_;
  std::size_t taken_ = 0;  ///< of the piece
  MdfFile::Extent plain_;  ///< what is left of a plain block
};

}  // namespace flexspline::data
