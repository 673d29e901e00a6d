#pragma once

#include <string>
#include <string_view>

namespace flexspline::data {

/// A cell for a message: at most 40 bytes, what is no printable UTF-8 escaped.
std::string shown(std::string_view cell);

bool is_utf8(std::string_view text);
std::string utf8_of_latin1(std::string_view text);

}  // namespace flexspline::data
