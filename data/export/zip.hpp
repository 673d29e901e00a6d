#pragma once

#include <string>
#include <vector>

#include "flexspline/data/exporter.hpp"

namespace flexspline::data {

/// The bytes of a ZIP archive of these files, deflated. Errors: cannot_write, with libzip's reason.
Result<std::string> zipped(const std::vector<ExportedFile>& files);

}  // namespace flexspline::data
