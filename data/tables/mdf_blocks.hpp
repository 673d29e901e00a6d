#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "tables/input_file.hpp"

namespace flexspline::data {

/// A block of an MDF4 file (ASAM MDF 4.1): its kind, links to others and data. Numbers are read
/// with bounds: past the end of the data they are 0.
struct MdfBlock {
  std::string kind;  ///< "HD", "DG", ...
  std::vector<std::uint64_t> links;
  std::string data;

  std::uint64_t link(std::size_t i) const { return i < links.size() ? links[i] : 0; }
  std::uint64_t number(std::size_t at, std::size_t bytes) const;
  double real(std::size_t at) const;
};

/// Blocks of a file, by their place. Lengths and links are checked against the file before anything
/// is taken.
class MdfFile {
 public:
  explicit MdfFile(const InputFile& file) : file_(file) {}

  /// A block of a kind. Errors: bad_data, where there is none at that place.
  Result<MdfBlock> block(std::uint64_t at, std::string_view kind) const;
  /// The kind of a block; empty where there is none.
  std::string kind_at(std::uint64_t at) const;
  /// Of a text block, or the text in the XML of one; empty where there is none.
  std::string text(std::uint64_t at) const;
  /// Links from block to block by their first link. Errors: bad_data, on a circle.
  Result<std::vector<std::uint64_t>> chain(std::uint64_t first, std::string_view kind,
                                           std::size_t most) const;
  const InputFile& file() const { return file_; }

  /// Where the data of a block lie, without reading them.
  struct Extent {
    std::uint64_t at = 0;
    std::uint64_t bytes = 0;
  };
  Result<Extent> extent(std::uint64_t at, std::string_view kind) const;

 private:
  struct Head {
    std::string kind;
    std::uint64_t bytes = 0;
    std::uint64_t links = 0;
  };
  Result<Head> head(std::uint64_t at) const;

  const InputFile& file_;
};

}  // namespace flexspline::data
