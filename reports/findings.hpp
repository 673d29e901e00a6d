#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "flexspline/reports/section.hpp"

namespace flexspline::reports {

/// Recordings by the name under which they are shown, and what looks mistaken in them.
struct LookedAt {
  std::string name;  ///< empty: those of the page
  std::vector<ShownFinding> findings;
};

ShownFinding parse_finding(const nlohmann::json& from);

/// The first section of every page of recordings: what looks mistaken in them, or that nothing
/// does.
Section findings_section(const std::vector<LookedAt>& recordings);

}  // namespace flexspline::reports
