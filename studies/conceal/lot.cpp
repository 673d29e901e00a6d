#include "conceal/lot.hpp"

#include <charconv>

#include <fmt/format.h>

#include "flexspline/data/checksum.hpp"

namespace flexspline::studies {

std::uint64_t lot_bits(std::uint64_t seed, std::string_view what, std::uint64_t index) {
  const std::string hex = data::sha256_hex(fmt::format("{}/{}/{}", seed, what, index));
  std::uint64_t bits = 0;
  std::from_chars(hex.data(), hex.data() + 16, bits, 16);
  return bits >> 11;
}

double lot(std::uint64_t seed, std::string_view what, std::uint64_t index) {
  return static_cast<double>(lot_bits(seed, what, index)) * 0x1p-53;
}

}  // namespace flexspline::studies
