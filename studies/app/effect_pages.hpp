#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "flexspline/core/effect.hpp"

namespace flexspline::app {

/// Where an effect enters and with which sign, in words and by the equation of Dhaouadi and
/// Ghorbel (2003).
std::string_view site_in_words(Site site);

/// What is known of an effect in Markdown, all of it from the row, with its equation in this form.
std::string effect_text(const EffectRow& row, std::string_view equation);

/// Its page: the equation set as mathematics, and its picture.
std::string effect_page(const EffectRow& row);

/// The table of all effects, with links to their pages.
std::string effect_index();

/// Errors: cannot_write, where a file of a page's name is there that is none.
Result<void> check_effect_pages(const std::filesystem::path& folder);

/// Writes <id>.md for every effect and README.md. Errors: cannot_write.
Result<void> write_effect_pages(const std::filesystem::path& folder);

}  // namespace flexspline::app
