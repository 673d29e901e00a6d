#include "flexspline/core/text_place.hpp"

#include <algorithm>

namespace flexspline {

TextPlace place_of(std::string_view text, std::size_t byte) {
  const std::string_view before = text.substr(0, std::min(byte, text.size()));
  const auto lines = static_cast<std::size_t>(std::ranges::count(before, '\n'));
  const std::size_t begin = before.rfind('\n');
  return {lines + 1, before.size() - (begin == std::string_view::npos ? 0 : begin + 1) + 1};
}

}  // namespace flexspline
