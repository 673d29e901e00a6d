#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace flexspline::data {

/// A form of file that nobody here reads, told by its first bytes: what it is, and the way out.
struct ForeignForm {
  std::string_view is;
  std::string_view way_out;
};
std::optional<ForeignForm> foreign_form(std::string_view head);

}  // namespace flexspline::data
