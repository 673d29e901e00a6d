#pragma once

#include <string>
#include <string_view>

namespace flexspline::reports {

/// Text as a page carries it: gzip (RFC 1952, no time stamp, so that equal text gives equal bytes),
/// then base64 (RFC 4648), whose letters cannot end a script. Figures shrink to about a third. A
/// text that zlib cannot take (no memory) gives an empty string.
std::string packed(std::string_view text);

}  // namespace flexspline::reports
