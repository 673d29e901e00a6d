#pragma once

#include <map>
#include <string>
#include <string_view>

namespace flexspline::data {

/// A text with every @key@ replaced by its word.
std::string filled(std::string_view text, const std::map<std::string, std::string>& words);

}  // namespace flexspline::data
