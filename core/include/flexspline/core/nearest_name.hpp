#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace flexspline {

/// The known name that a misspelt one most probably means: the fewest insertions, deletions,
/// replacements and swaps of neighbours, letter case aside. Nothing when all of them need more
/// than a third of the given letters (one for short names) changed. Ties: the first.
std::optional<std::string_view> nearest_name(std::string_view given,
                                             std::span<const std::string_view> known);

/// "did you mean 'nearest'?", or "known: a, b, c" when no name is near.
std::string suggestion(std::string_view given, std::span<const std::string_view> known);

}  // namespace flexspline
