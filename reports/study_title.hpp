#pragma once

#include <string>

namespace flexspline::reports {

/// The study's title or name out of its lock file; a general one where it has none.
std::string study_title(const std::string& lock);

}  // namespace flexspline::reports
