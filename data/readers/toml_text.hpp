#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace flexspline::data {

/// A TOML basic string, quoted and escaped.
std::string toml_quoted(std::string_view text);

/// A TOML float that reads back to the same bits.
std::string toml_number(double value);

/// A TOML list of floats, one line.
std::string toml_list(const std::vector<double>& values);

}  // namespace flexspline::data
