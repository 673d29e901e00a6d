#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "flexspline/core/effect.hpp"

namespace flexspline::app {

/// Where an effect enters and with which sign, in words and by the equation of Dhaouadi and
/// Ghorbel (2003).
std::string_view site_in_words(Site site);

/// An effect's page in Markdown, all of it from the row.
std::string effect_page(const EffectRow& row);

/// The table of all effects, with links to their pages.
std::string effect_index();

/// Errors: cannot_write, where a file of a page's name is there that is none.
Result<void> check_effect_pages(const std::filesystem::path& folder);

/// Writes <id>.md for every effect and README.md. Errors: cannot_write.
Result<void> write_effect_pages(const std::filesystem::path& folder);

}  // namespace flexspline::app
