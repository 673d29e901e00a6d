#pragma once

#include <string>
#include <string_view>

#include "flexspline/core/error.hpp"

namespace flexspline::data {

/// What a block of a file holds that is packed by "lz4" (frames) or "zstd", or is as it is (""). It
/// has exactly so many bytes. Errors: bad_data, for another packing, for more or fewer bytes.
Result<std::string> unpacked(std::string_view packing, std::string_view block, std::size_t bytes);

}  // namespace flexspline::data
