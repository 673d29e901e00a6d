#include "tables/mcap_bag.hpp"

#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cstring>

#include <fmt/format.h>

#include "tables/unpacked.hpp"

namespace flexspline::data {
namespace {

static_assert(std::endian::native == std::endian::little, "MCAP's numbers are read as they lie");

constexpr std::uint64_t kMostRecord = std::uint64_t{1} << 28U;

enum Kind : std::uint8_t { schema = 3, channel = 4, message = 5, packed = 6, data_end = 15 };

tl::unexpected<Error> damaged(const std::string& what) {
  return failure(ErrorCode::bad_data, what,
                 "the file is cut or damaged; mcap recover may save a part of it");
}

/// Fields of a record, one after the other.
class Fields {
 public:
  explicit Fields(std::string_view rest) : rest_(rest) {}

  bool good() const { return good_; }
  std::string_view rest() const { return rest_; }

  template <class Number>
  Number number() {
    Number value{};
    const std::string_view raw = bytes(sizeof value);
    if (good_) std::memcpy(&value, raw.data(), sizeof value);
    return value;
  }

  std::string_view text() { return bytes(number<std::uint32_t>()); }

  std::string_view bytes(std::uint64_t count) {
    good_ = good_ && count <= rest_.size();
    if (!good_) return {};
    const std::string_view taken = rest_.substr(0, count);
    rest_.remove_prefix(count);
    return taken;
  }

 private:
  std::string_view rest_;
  bool good_ = true;
};

}  // namespace

Result<void> McapBag::records(const TakeRecord& take) const {
  std::size_t at = kMcapMark.size();
  while (at + 9 <= file_.size()) {
    const auto head = file_.read(at, 9);
    if (!head) return tl::unexpected(head.error());
    Fields fields(*head);
    const auto kind = fields.number<std::uint8_t>();
    const auto size = fields.number<std::uint64_t>();
    at += 9;
    if (!fields.good() || size > file_.size() - at) {
      return damaged(fmt::format("a record at byte {} ends behind the file", at - 9));
    }
    if (kind == data_end) return {};
    const bool needed = kind >= schema && kind <= packed;
    if (needed && size > kMostRecord) return damaged("a record of more than 256 MiB");
    if (needed) {
      const auto content = file_.read(at, size);
      if (!content) return tl::unexpected(content.error());
      const auto went = kind == packed ? chunk(*content, take) : take(kind, *content);
      if (!went) return tl::unexpected(went.error());
      if (*went == Go::enough) return {};
    }
    at += size;
  }
  return damaged("it has no end");
}

Result<McapBag::Go> McapBag::chunk(std::string_view content, const TakeRecord& take) const {
  Fields fields(content);
  fields.bytes(16);  // the times of its first and last message
  const auto size = fields.number<std::uint64_t>();
  const auto sum = fields.number<std::uint32_t>();
  const std::string_view packing = fields.text();
  const std::string_view block = fields.bytes(fields.number<std::uint64_t>());
  if (!fields.good() || size > kMostRecord) return damaged("a chunk that is no chunk");
  const auto plain = unpacked(packing, block, size);
  if (!plain) return tl::unexpected(plain.error());
  const auto found =
      crc32(0, reinterpret_cast<const Bytef*>(plain->data()), static_cast<uInt>(plain->size()));
  if (sum != 0 && sum != found) return damaged("the checksum of a chunk does not hold");
  Fields records(*plain);
  while (!records.rest().empty()) {
    const auto kind = records.number<std::uint8_t>();
    const std::string_view one = records.bytes(records.number<std::uint64_t>());
    if (!records.good()) return damaged("a record ends behind its chunk");
    if (kind != schema && kind != channel && kind != message) continue;
    const auto went = take(kind, one);
    if (!went || *went == Go::enough) return went;
  }
  return Go::on;
}

void McapBag::learn_channel(std::string_view content) {
  Fields fields(content);
  const auto id = fields.number<std::uint16_t>();
  const auto of = schemas_.find(fields.number<std::uint16_t>());
  BagTopic topic;
  topic.id = id;
  topic.name = fields.text();
  topic.serialisation = fields.text();
  if (!fields.good()) return;
  if (std::ranges::find(topics_, topic.id, &BagTopic::id) != topics_.end()) return;
  if (of != schemas_.end()) {
    topic.type = of->second.name;
    if (of->second.encoding == "ros2msg") topic.definition = of->second.text;
  }
  topics_.push_back(std::move(topic));
}

Result<McapBag::Go> McapBag::learn(std::uint8_t kind, std::string_view content) {
  if (kind == channel) learn_channel(content);
  if (kind == schema) {
    Fields fields(content);
    const auto id = fields.number<std::uint16_t>();
    Schema one;
    one.name = fields.text();
    one.encoding = fields.text();
    one.text = fields.text();
    if (fields.good()) schemas_.try_emplace(id, std::move(one));
  }
  if (topics_.size() > limits_.tables) {
    return failure(ErrorCode::bad_data, fmt::format("more than {} topics", limits_.tables));
  }
  return Go::on;
}

Result<McapBag> McapBag::open(const InputFile& file, const TableLimits& limits) {
  McapBag bag(file, limits);
  auto read = bag.records(
      [&](std::uint8_t kind, std::string_view content) { return bag.learn(kind, content); });
  if (!read) return tl::unexpected(read.error());
  return bag;
}

Result<void> McapBag::messages(const BagTopic& topic, const BagMessage& take) {
  return records([&](std::uint8_t kind, std::string_view content) -> Result<Go> {
    if (kind != message) return Go::on;
    Fields fields(content);
    if (fields.number<std::uint16_t>() != topic.id) return Go::on;
    fields.bytes(4);  // its number
    const auto logged = fields.number<std::uint64_t>();
    fields.bytes(8);  // when it was published
    if (!fields.good()) return damaged("a message that is none");
    return take(static_cast<std::int64_t>(logged), fields.rest()) ? Go::on : Go::enough;
  });
}

}  // namespace flexspline::data
