#pragma once

#include <optional>
#include <string>
#include <vector>

#include "flexspline/data/exporter.hpp"

namespace flexspline::data {

/// The shared library of some C sources by the compiler cc for this machine; nothing where there is
/// none or it refuses them.
std::optional<std::string> compile_shared(const std::vector<ExportedFile>& sources);

}  // namespace flexspline::data
