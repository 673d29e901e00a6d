#include "readers/toml_text.hpp"

#include <fmt/format.h>

#include <cmath>

namespace flexspline::data {

std::string toml_quoted(std::string_view text) {
  std::string quoted = "\"";
  for (const char letter : text) {
    if (letter == '"' || letter == '\\') {
      quoted += {'\\', letter};
    } else if (static_cast<unsigned char>(letter) < 0x20 || letter == 0x7F) {
      quoted += fmt::format("\\u{:04X}", static_cast<unsigned>(letter));
    } else {
      quoted += letter;
    }
  }
  return quoted + '"';
}

std::string toml_number(double value) {
  std::string text = fmt::format("{}", value);
  const bool is_float = !std::isfinite(value) || text.find_first_of(".e") != text.npos;
  return is_float ? text : text + ".0";
}

std::string toml_list(const std::vector<double>& values) {
  std::string text = "[";
  for (const double value : values) text += (text.size() > 1 ? ", " : "") + toml_number(value);
  return text + "]";
}

}  // namespace flexspline::data
