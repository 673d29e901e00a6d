#include "tables/mdf_data.hpp"

#include <zlib.h>

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

namespace flexspline::data {
namespace {

constexpr std::size_t kMostBlocks = 1U << 22U;
constexpr std::uint64_t kPiece = std::uint64_t{1} << 20U;
constexpr std::uint64_t kMostInflated = std::uint64_t{1} << 28U;
constexpr std::uint64_t kMostRatio = 1040;  // of deflate

tl::unexpected<Error> damaged(std::uint64_t at, const std::string& why) {
  return failure(ErrorCode::bad_data, fmt::format("at byte {}: {}", at, why),
                 "the file is cut or damaged; measure or export it again");
}

/// Bytes that were stored column by column, back to rows of so many; what is over stays.
std::string rows_of_columns(const std::string& bytes, std::size_t width) {
  const std::size_t rows = width == 0 ? 0 : bytes.size() / width;
  if (rows < 2) return bytes;
  std::string result(bytes);
  for (std::size_t c = 0; c < width; ++c) {
    for (std::size_t r = 0; r < rows; ++r) result[r * width + c] = bytes[c * rows + r];
  }
  return result;
}

}  // namespace

Result<MdfData> MdfData::open(const MdfFile& file, std::uint64_t first) {
  MdfData data(file);
  if (first == 0) return data;
  if (auto listed = data.list(first); !listed) return tl::unexpected(listed.error());
  return data;
}

Result<void> MdfData::list(std::uint64_t at) {
  const std::string kind = file_.kind_at(at);
  if (kind == "DT" || kind == "DZ") {
    blocks_.push_back(at);
    return {};
  }
  if (kind == "HL") {
    const auto head = file_.block(at, "HL");
    if (!head) return tl::unexpected(head.error());
    at = head->link(0);
    if (at == 0) return {};
  }
  const auto lists = file_.chain(at, "DL", kMostBlocks);
  if (!lists) return tl::unexpected(lists.error());
  for (const std::uint64_t place : *lists) {
    const auto one = file_.block(place, "DL");
    if (!one) return tl::unexpected(one.error());
    for (std::size_t i = 1; i < one->links.size(); ++i) {
      if (one->links[i] != 0) blocks_.push_back(one->links[i]);
    }
    if (blocks_.size() > kMostBlocks) return damaged(place, "too many blocks of data");
  }
  return {};
}

Result<bool> MdfData::next_piece() {
  piece_.clear();
  taken_ = 0;
  if (plain_.bytes == 0) {
    if (block_ == blocks_.size()) return false;
    const std::uint64_t at = blocks_[block_++];
    if (file_.kind_at(at) == "DZ") {
      if (auto done = inflate(at); !done) return tl::unexpected(done.error());
      return true;
    }
    const auto where = file_.extent(at, "DT");
    if (!where) return tl::unexpected(where.error());
    plain_ = *where;
  }
  auto bytes = file_.file().read(plain_.at, std::min(plain_.bytes, kPiece));
  if (!bytes) return tl::unexpected(bytes.error());
  if (bytes->empty() && plain_.bytes > 0)
    return damaged(plain_.at, "the data end before their block");
  plain_ = {plain_.at + bytes->size(), plain_.bytes - bytes->size()};
  piece_ = *std::move(bytes);
  return true;
}

Result<void> MdfData::inflate(std::uint64_t at) {
  const auto where = file_.extent(at, "DZ");
  if (!where) return tl::unexpected(where.error());
  constexpr std::uint64_t kOwn = 24;  // before the packed bytes
  const auto head = file_.file().read(where->at, kOwn);
  if (!head || head->size() < kOwn || where->bytes < kOwn) return damaged(at, "no packed data");
  const MdfBlock own{"DZ", {}, *head};
  const std::uint64_t zip = own.number(2, 1);
  const std::uint64_t width = own.number(4, 4);
  const std::uint64_t inflated = own.number(8, 8);
  const std::uint64_t packed = own.number(16, 8);
  if (zip > 1) return damaged(at, fmt::format("packed in the unknown way {}", zip));
  if (packed > where->bytes - kOwn || inflated > kMostInflated ||
      inflated > kMostRatio * (packed + 16)) {
    return damaged(at, "the packed data are not as long as they say");
  }
  const auto bytes = file_.file().read(where->at + kOwn, packed);
  if (!bytes) return tl::unexpected(bytes.error());
  piece_.resize(inflated);
  uLongf size = inflated;
  const int code = uncompress(reinterpret_cast<Bytef*>(piece_.data()), &size,
                              reinterpret_cast<const Bytef*>(bytes->data()), bytes->size());
  if (code != Z_OK || size != inflated) return damaged(at, "the packed data cannot be unpacked");
  if (zip == 1) piece_ = rows_of_columns(piece_, width);
  return {};
}

Result<std::size_t> MdfData::read(char* to, std::size_t count) {
  std::size_t got = 0;
  while (got < count) {
    if (taken_ == piece_.size()) {
      const auto more = next_piece();
      if (!more) return tl::unexpected(more.error());
      if (!*more) break;
      continue;
    }
    const std::size_t some = std::min(count - got, piece_.size() - taken_);
    std::memcpy(to + got, piece_.data() + taken_, some);
    got += some, taken_ += some;
  }
  return got;
}

}  // namespace flexspline::data
