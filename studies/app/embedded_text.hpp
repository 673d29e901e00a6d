#pragma once

#include <span>
#include <string_view>

namespace flexspline::app {

/// A file that the program carries with it.
struct EmbeddedText {
  std::string_view name;
  std::string_view text;
};

/// Every data/schemas/<name>.schema.json.
std::span<const EmbeddedText> schemas();

/// Every data/templates/<name>.toml.
std::span<const EmbeddedText> templates();

}  // namespace flexspline::app
