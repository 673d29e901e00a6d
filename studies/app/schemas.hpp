#pragma once

#include <span>
#include <string_view>

namespace flexspline::app {

/// A JSON schema that the program carries with it.
struct SchemaText {
  std::string_view name;
  std::string_view text;
};

/// Every data/schemas/<name>.schema.json.
std::span<const SchemaText> schemas();

}  // namespace flexspline::app
