#include "readers/cell_text.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace flexspline::data {
namespace {

/// Bytes of the UTF-8 letter at the head of a text; 0 where there is none.
std::size_t utf8_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char lead = byte(0);
  const std::size_t length = lead < 0x80                   ? 1
                             : lead >= 0xC2 && lead < 0xE0 ? 2
                             : lead >= 0xE0 && lead < 0xF0 ? 3
                             : lead >= 0xF0 && lead < 0xF5 ? 4
                                                           : 0;
  if (length > text.size()) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0U) != 0x80) return 0;
  }
  const unsigned char second = length > 2 ? byte(1) : 0;  // overlong, surrogates, beyond U+10FFFF
  if ((lead == 0xE0 && second < 0xA0) || (lead == 0xED && second > 0x9F)) return 0;
  if ((lead == 0xF0 && second < 0x90) || (lead == 0xF4 && second > 0x8F)) return 0;
  return length;
}

}  // namespace

std::string shown(std::string_view cell) {
  constexpr std::size_t kMost = 40;
  std::string text;
  while (!cell.empty() && text.size() < kMost) {
    const auto byte = static_cast<unsigned char>(cell.front());
    const std::size_t length = byte < 0x20 || byte == 0x7F ? 0 : utf8_length(cell);
    text += length == 0 ? fmt::format("\\x{:02X}", byte) : std::string(cell.substr(0, length));
    cell.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return cell.empty() ? text : text + "…";
}

bool is_utf8(std::string_view text) {
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    if (length == 0) return false;
    text.remove_prefix(length);
  }
  return true;
}

std::string utf8_of_latin1(std::string_view text) {
  std::string utf8;
  for (const char letter : text) {
    const auto byte = static_cast<unsigned char>(letter);
    if (byte < 0x80) {
      utf8 += letter;
    } else {
      utf8 += static_cast<char>(0xC0U | (byte >> 6U));
      utf8 += static_cast<char>(0x80U | (byte & 0x3FU));
    }
  }
  return utf8;
}

}  // namespace flexspline::data
