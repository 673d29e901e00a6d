#pragma once

#include <filesystem>
#include <vector>

#include "flexspline/studies/verify.hpp"

namespace flexspline::studies {

/// What two folders were computed from differently, from their lock files or the artefacts that
/// name it. A folder that does not say is not blamed.
std::vector<Circumstance> changed_circumstances(const std::filesystem::path& folder,
                                                const std::filesystem::path& against);

}  // namespace flexspline::studies
