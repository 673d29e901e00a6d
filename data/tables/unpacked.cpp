#include "tables/unpacked.hpp"

#include <lz4frame.h>
#include <zstd.h>

#include <memory>

#include <fmt/format.h>

namespace flexspline::data {
namespace {

/// Bytes that came out; more than it may have where it does not end.
std::size_t from_zstd(std::string_view block, std::string& to) {
  const std::size_t got = ZSTD_decompress(to.data(), to.size(), block.data(), block.size());
  return ZSTD_isError(got) != 0 ? to.size() + 1 : got;
}

std::size_t from_lz4(std::string_view block, std::string& to) {
  LZ4F_dctx* raw = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&raw, LZ4F_VERSION)) != 0) return to.size() + 1;
  const std::unique_ptr<LZ4F_dctx, decltype(&LZ4F_freeDecompressionContext)> context(
      raw, LZ4F_freeDecompressionContext);
  std::size_t got = 0;
  std::size_t left = 1;
  while (left != 0 && !block.empty()) {
    std::size_t out = to.size() - got;
    std::size_t in = block.size();
    left = LZ4F_decompress(raw, to.data() + got, &out, block.data(), &in, nullptr);
    if (LZ4F_isError(left) != 0 || (in == 0 && out == 0)) return to.size() + 1;
    got += out;
    block.remove_prefix(in);
  }
  return left == 0 ? got : to.size() + 1;
}

}  // namespace

Result<std::string> unpacked(std::string_view packing, std::string_view block, std::size_t bytes) {
  if (packing.empty() && block.size() == bytes) return std::string(block);
  if (!packing.empty() && packing != "lz4" && packing != "zstd") {
    return failure(ErrorCode::bad_data, fmt::format("it is packed by '{}'; lz4 and zstd are read",
                                                    packing.substr(0, 32)));
  }
  std::string to(packing.empty() ? 0 : bytes, '\0');
  const std::size_t got = packing == "zstd"  ? from_zstd(block, to)
                          : packing == "lz4" ? from_lz4(block, to)
                                             : block.size();
  if (got == bytes) return to;
  return failure(ErrorCode::bad_data, "a chunk does not unpack to what it says",
                 "the file is damaged; mcap recover may save the rest of it");
}

}  // namespace flexspline::data
