#pragma once

#include <cstddef>
#include <string_view>

namespace flexspline {

/// Where a person finds a byte of a text, both from 1 on; columns are bytes.
struct TextPlace {
  std::size_t line = 1;
  std::size_t column = 1;
};

/// The place of a byte, or of the end where the text is shorter.
TextPlace place_of(std::string_view text, std::size_t byte);

}  // namespace flexspline
