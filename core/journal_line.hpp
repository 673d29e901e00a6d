#pragma once

#include <string>
#include <string_view>

#include "flexspline/core/journal.hpp"

namespace flexspline {

/// A record as its line, with the line end.
std::string journal_line(JournalFields fields);

/// What stands behind the checksum of a line, where it holds; data() is null where it does not.
std::string_view checked_record(std::string_view line);

}  // namespace flexspline
