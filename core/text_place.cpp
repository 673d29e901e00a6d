#include "flexspline/core/text_place.hpp"

#include <algorithm>

namespace flexspline {

TextPlace place_of(std::string_view text, std::size_t byte) {
  const std::string_view before = text.substr(0, std::min(byte, text.size()));
  const auto lines = static_cast<std::size_t>(std::ranges::count(before, '\n'));
  const std::size_t begin = before.rfind('\n');
  return {lines + 1, before.size() - (begin == std::string_view::npos ? 0 : begin + 1) + 1};
}

std::size_t nesting_of(std::string_view json) {
  std::size_t depth = 0;
  std::size_t deepest = 0;
  bool quoted = false;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const char letter = json[i];
    if (letter == '"') quoted = !quoted;
    if (quoted && letter == '\\') ++i;
    if (quoted) continue;
    if (letter == '{' || letter == '[') deepest = std::max(deepest, ++depth);
    if ((letter == '}' || letter == ']') && depth > 0) --depth;
  }
  return deepest;
}

}  // namespace flexspline
