#pragma once

#include <string>
#include <string_view>

namespace flexspline::data {

enum class Encoding { utf8, latin1, utf16_little, utf16_big };

struct SniffedEncoding {
  Encoding encoding = Encoding::utf8;
  std::size_t mark_bytes = 0;  ///< of the byte-order mark
};

std::string_view name_of(Encoding encoding);

/// By the byte-order mark; zeros in every other byte; bytes that are no UTF-8.
SniffedEncoding sniff_encoding(std::string_view head);

/// Text without control characters other than those that end and separate lines and cells.
bool looks_like_text(std::string_view head);

/// Whole letters to UTF-8; an odd byte at the end is left out.
std::string decoded(std::string_view bytes, Encoding encoding);

}  // namespace flexspline::data
