#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "flexspline/data/sanity.hpp"
#include "sanity/observed.hpp"

namespace flexspline::data {

/// A row of the catalogue of checks, one file each in data/sanity/checks.
struct SanityRow {
  std::string_view id;
  std::string_view says;  ///< what it looks for
  std::vector<SanityFinding> (*find)(const ObservedSet&) = nullptr;
};

std::span<const SanityRow> sanity_checks();

}  // namespace flexspline::data
