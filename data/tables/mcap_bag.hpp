#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "tables/bag_tables.hpp"
#include "tables/input_file.hpp"

namespace flexspline::data {

inline constexpr std::string_view kMcapMark{"\x89MCAP0\r\n", 8};

/// A file of MCAP 0, read from its beginning to its end: its index is not needed and not trusted.
class McapBag : public Bag {
 public:
  /// Errors: bad_data, for a file that is cut or damaged, or asks for more than the limits.
  static Result<McapBag> open(const InputFile& file, const TableLimits& limits);

  const std::vector<BagTopic>& topics() const override { return topics_; }
  Result<void> messages(const BagTopic& topic, const BagMessage& take) override;

 private:
  struct Schema {
    std::string name, encoding, text;
  };
  enum class Go { on, enough };
  using TakeRecord = std::function<Result<Go>(std::uint8_t, std::string_view)>;

  McapBag(const InputFile& file, const TableLimits& limits) : file_(file), limits_(limits) {}
  Result<void> records(const TakeRecord& take) const;
  Result<Go> chunk(std::string_view content, const TakeRecord& take) const;
  Result<Go> learn(std::uint8_t kind, std::string_view content);
  void learn_channel(std::string_view content);

  const InputFile& file_;
  const TableLimits& limits_;
  std::map<std::uint16_t, Schema> schemas_;
  std::vector<BagTopic> topics_;
};

}  // namespace flexspline::data
