#include "tables/mdf_channel.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace flexspline::data {
namespace {

MdfConversion conversion_of(const MdfFile& file, std::uint64_t at, bool& is_text) {
  MdfConversion conversion;
  if (at == 0) return conversion;
  const auto block = file.block(at, "CC");
  if (!block) return conversion;
  const auto kind = block->number(0, 1);
  const auto count = block->number(6, 2);
  for (std::size_t i = 0; i < count && 24 + 8 * i + 8 <= block->data.size(); ++i) {
    conversion.values.push_back(block->real(24 + 8 * i));
  }
  const std::size_t held = conversion.values.size();
  using Kind = MdfConversion::Kind;
  if (kind == 1 && held >= 2) conversion.kind = Kind::linear;
  if (kind == 2 && held >= 6) conversion.kind = Kind::rational;
  if (kind == 4 && held >= 2) conversion.kind = Kind::interpolated;
  if (kind == 5 && held >= 2) conversion.kind = Kind::stepped;
  is_text = kind == 3 || kind > 5;
  return conversion;
}

std::string unit_of(const MdfFile& file, const MdfBlock& channel) {
  const std::string own = file.text(channel.link(6));
  if (!own.empty() || channel.link(4) == 0) return own;
  const auto conversion = file.block(channel.link(4), "CC");
  return conversion ? file.text(conversion->link(1)) : own;
}

/// Key and value pairs, keys rising.
double looked_up(const std::vector<double>& pairs, double key, bool between) {
  const std::size_t count = pairs.size() / 2;
  std::size_t next = 0;
  while (next < count && pairs[2 * next] < key) ++next;
  if (next == 0) return pairs[1];
  if (next == count) return pairs[2 * count - 1];
  const double low = pairs[2 * next - 2];
  const double high = pairs[2 * next];
  const double share = high > low ? (key - low) / (high - low) : 1.0;
  if (!between) return pairs[share > 0.5 ? 2 * next + 1 : 2 * next - 1];
  return pairs[2 * next - 1] + share * (pairs[2 * next + 1] - pairs[2 * next - 1]);
}

std::uint64_t raw_bits(const MdfChannel& one, std::string_view record) {
  const std::size_t bytes = (one.bit + one.bits + 7) / 8;
  std::uint64_t raw = 0;
  for (std::size_t i = 0; i < bytes; ++i) {
    const std::size_t at = one.byte + (one.big_endian ? i : bytes - 1 - i);
    raw = (raw << 8U) | static_cast<unsigned char>(record[at]);
  }
  raw >>= one.bit;
  return one.bits == 64 ? raw : raw & ((std::uint64_t{1} << one.bits) - 1);
}

}  // namespace

double MdfConversion::operator()(double raw) const {
  const auto& p = values;
  switch (kind) {
    case Kind::none:
      return raw;
    case Kind::linear:
      return p[0] + p[1] * raw;
    case Kind::rational:
      return ((p[0] * raw + p[1]) * raw + p[2]) / ((p[3] * raw + p[4]) * raw + p[5]);
    case Kind::interpolated:
      return looked_up(p, raw, true);
    case Kind::stepped:
      break;
  }
  return looked_up(p, raw, false);
}

double MdfChannel::value(std::string_view record, std::size_t data_bytes,
                         std::uint64_t index) const {
  constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
  if (counted) return conversion(static_cast<double>(index));
  if (invalid_bit) {
    const auto mark = static_cast<unsigned char>(record[data_bytes + *invalid_bit / 8]);
    if (((mark >> (*invalid_bit % 8)) & 1U) != 0) return kNothing;
  }
  const std::uint64_t raw = raw_bits(*this, record);
  double number = 0.0;
  if (is_real) {
    number = bits == 64
                 ? std::bit_cast<double>(raw)
                 : static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(raw)));
  } else if (is_signed) {
    const unsigned shift = 64 - bits;
    number = static_cast<double>(static_cast<std::int64_t>(raw << shift) >> shift);
  } else {
    number = static_cast<double>(raw);
  }
  const double result = conversion(number);
  return std::isfinite(result) ? result : kNothing;
}

std::optional<MdfChannel> mdf_channel(const MdfFile& file, const MdfBlock& block,
                                      std::size_t data_bytes, std::size_t invalid_bytes) {
  const auto kind = block.number(0, 1);
  const auto sync = block.number(1, 1);
  const auto type = block.number(2, 1);
  const auto flags = block.number(12, 4);
  MdfChannel one;
  bool is_text = false;
  one.conversion = conversion_of(file, block.link(4), is_text);
  one.column = {file.text(block.link(2)), unit_of(file, block),
                (kind == 2 || kind == 3) && sync == 1};
  if (one.column.clock && one.column.unit.empty()) one.column.unit += 's';
  one.counted = kind == 3 || kind == 6;
  const bool fixed = kind == 0 || kind == 2 || kind == 4 || one.counted;
  if (!fixed || type > 5 || is_text || (flags & 1U) != 0 || block.link(1) != 0) return std::nullopt;
  if (one.counted) return one;
  one.is_signed = type == 2 || type == 3;
  one.is_real = type == 4 || type == 5;
  one.big_endian = type % 2 == 1;
  one.bit = static_cast<unsigned>(block.number(3, 1));
  one.byte = block.number(4, 4);
  one.bits = static_cast<unsigned>(std::min<std::uint64_t>(block.number(8, 4), 1000));
  const bool size_fits = one.is_real ? one.bits == 32 || one.bits == 64 : one.bits >= 1;
  const std::size_t bytes = (one.bit + one.bits + 7) / 8;
  if (!size_fits || bytes > 8 || one.byte > data_bytes || data_bytes - one.byte < bytes) {
    return std::nullopt;
  }
  const std::size_t mark = block.number(16, 4);
  if ((flags & 2U) != 0 && mark / 8 < invalid_bytes) one.invalid_bit = mark;
  return one;
}

}  // namespace flexspline::data
