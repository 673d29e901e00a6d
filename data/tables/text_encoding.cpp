#include "tables/text_encoding.hpp"

#include <algorithm>
#include <cstdint>

#include "readers/cell_text.hpp"

namespace flexspline::data {
namespace {

bool is_wide(Encoding encoding) {
  return encoding == Encoding::utf16_little || encoding == Encoding::utf16_big;
}

void append_letter(std::string& text, std::uint32_t letter) {
  const auto tail = [&](unsigned shift) {
    text += static_cast<char>(0x80U | ((letter >> shift) & 0x3FU));
  };
  if (letter < 0x80) {
    text += static_cast<char>(letter);
  } else if (letter < 0x800) {
    text += static_cast<char>(0xC0U | (letter >> 6U));
    tail(0);
  } else if (letter < 0x10000) {
    text += static_cast<char>(0xE0U | (letter >> 12U));
    tail(6), tail(0);
  } else {
    text += static_cast<char>(0xF0U | (letter >> 18U));
    tail(12), tail(6), tail(0);
  }
}

std::string decoded_wide(std::string_view bytes, bool little) {
  const auto unit_at = [&](std::size_t i) -> std::uint32_t {
    const auto low = static_cast<unsigned char>(bytes[i + (little ? 0 : 1)]);
    const auto high = static_cast<unsigned char>(bytes[i + (little ? 1 : 0)]);
    return low | (static_cast<std::uint32_t>(high) << 8U);
  };
  constexpr std::uint32_t kNoLetter = 0xFFFD;
  std::string text;
  text.reserve(bytes.size() / 2);
  for (std::size_t i = 0; i + 1 < bytes.size(); i += 2) {
    std::uint32_t letter = unit_at(i);
    const bool lead = letter >= 0xD800 && letter < 0xDC00;
    const std::uint32_t trail = lead && i + 3 < bytes.size() ? unit_at(i + 2) : 0;
    if (trail >= 0xDC00 && trail < 0xE000) {
      letter = 0x10000 + ((letter - 0xD800) << 10U) + (trail - 0xDC00);
      i += 2;
    } else if (letter >= 0xD800 && letter < 0xE000) {
      letter = kNoLetter;
    }
    append_letter(text, letter);
  }
  return text;
}

/// A letter cut at the end of a piece is no sign of another encoding.
std::string_view without_cut_letter(std::string_view text) {
  for (std::size_t back = 0; back < 3 && !text.empty(); ++back) {
    const auto last = static_cast<unsigned char>(text.back());
    if (last < 0x80) break;
    text.remove_suffix(1);
    if (last >= 0xC0) break;
  }
  return text;
}

}  // namespace

std::string_view name_of(Encoding encoding) {
  switch (encoding) {
    case Encoding::latin1:
      return "Latin-1";
    case Encoding::utf16_little:
    case Encoding::utf16_big:
      return "UTF-16";
    case Encoding::utf8:
      break;
  }
  return "UTF-8";
}

SniffedEncoding sniff_encoding(std::string_view head) {
  if (head.starts_with("\xEF\xBB\xBF")) return {Encoding::utf8, 3};
  if (head.starts_with("\xFF\xFE")) return {Encoding::utf16_little, 2};
  if (head.starts_with("\xFE\xFF")) return {Encoding::utf16_big, 2};
  std::size_t zeros[2] = {0, 0};
  const std::size_t looked = std::min<std::size_t>(head.size(), 512);
  for (std::size_t i = 0; i < looked; ++i) zeros[i % 2] += head[i] == '\0' ? 1 : 0;
  const std::size_t most = looked * 2 / 5;
  if (looked >= 8 && zeros[1] > most && zeros[0] == 0) return {Encoding::utf16_little, 0};
  if (looked >= 8 && zeros[0] > most && zeros[1] == 0) return {Encoding::utf16_big, 0};
  return {is_utf8(without_cut_letter(head)) ? Encoding::utf8 : Encoding::latin1, 0};
}

bool looks_like_text(std::string_view head) {
  const SniffedEncoding sniffed = sniff_encoding(head);
  const std::string text = decoded(head.substr(sniffed.mark_bytes), sniffed.encoding);
  return std::ranges::none_of(text, [](char letter) {
    const auto byte = static_cast<unsigned char>(letter);
    return byte < 0x20 && byte != '\t' && byte != '\n' && byte != '\r' && byte != '\f';
  });
}

std::string decoded(std::string_view bytes, Encoding encoding) {
  if (is_wide(encoding)) return decoded_wide(bytes, encoding == Encoding::utf16_little);
  if (encoding == Encoding::latin1) return utf8_of_latin1(bytes);
  return std::string(bytes);
}

}  // namespace flexspline::data
