#include "export/filled.hpp"

namespace flexspline::data {

std::string filled(std::string_view text, const std::map<std::string, std::string>& words) {
  std::string result(text);
  for (const auto& [key, word] : words) {
    const std::string mark = "@" + key + "@";
    for (std::size_t at = 0; (at = result.find(mark, at)) != std::string::npos; at += word.size()) {
      result.replace(at, mark.size(), word);
    }
  }
  return result;
}

}  // namespace flexspline::data
