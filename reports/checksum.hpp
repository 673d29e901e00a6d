#pragma once

#include <string>
#include <string_view>

namespace flexspline::reports {

/// SHA-256 in lower-case hexadecimal digits.
std::string sha256_of(std::string_view bytes);

/// Whether an artefact's "sha256" is that of its canonical dump without it (docs/artefacts.md).
/// The text has to be JSON.
bool checksum_holds(const std::string& artefact);

}  // namespace flexspline::reports
