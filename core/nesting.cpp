#include "flexspline/core/nesting.hpp"

#include <algorithm>
#include <string>

namespace flexspline {
namespace {

/// Past the string that opens here: basic or literal, of one line or (TOML) of several.
std::size_t past_string(std::string_view text, std::size_t at) {
  const char quote = text[at];
  const bool basic = quote == '"';
  const std::string fence(3, quote);
  const bool several = text.substr(at, 3) == fence;
  for (at += several ? 3 : 1; at < text.size(); ++at) {
    if (basic && text[at] == '\\') {
      ++at;
    } else if (several ? text.substr(at, 3) == fence : text[at] == quote || text[at] == '\n') {
      return at + (several ? 3 : 1);
    }
  }
  return text.size();
}

/// Brackets that are open, and dots since the last mark that ends a key.
class Depth {
 public:
  void see(char mark) {
    switch (mark) {
      case '[':
      case '{':
        ++brackets_;
        dots_ = 0;
        break;
      case ']':
      case '}':
        brackets_ = std::max(brackets_ - 1, 0);
        dots_ = 0;
        break;
      case '.':
        ++dots_;
        break;
      case '=':
      case ',':
      case '\n':
        dots_ = 0;
        break;
      default:
        break;
    }
  }
  bool too_deep() const { return brackets_ > kDeepestNesting || dots_ >= kDeepestNesting; }

 private:
  int brackets_ = 0;
  int dots_ = 0;
};

}  // namespace

Result<void> check_nesting(std::string_view text) {
  Depth depth;
  for (std::size_t at = 0; at < text.size();) {
    if (text[at] == '"' || text[at] == '\'') {
      at = past_string(text, at);
      continue;
    }
    if (text[at] == '#') at = std::min(text.find('\n', at), text.size() - 1);
    depth.see(text[at]);
    if (depth.too_deep()) {
      const auto line = std::count(text.begin(), text.begin() + static_cast<long>(at), '\n') + 1;
      return failure(ErrorCode::bad_data,
                     "line " + std::to_string(line) + " nests deeper than " +
                         std::to_string(kDeepestNesting) + " levels",
                     "no file of ours does: write it flat");
    }
    ++at;
  }
  return {};
}

}  // namespace flexspline
