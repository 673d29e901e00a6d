#pragma once

#include "flexspline/data/table_reader.hpp"

namespace flexspline::data {

/// What a reader does in a process of its own: it takes the bounds that the limits set, says to one
/// end of a socket what it reads, and ends.
[[noreturn]] void serve_reader(const TableReaderRow& reader, const std::filesystem::path& path,
                               const TableRequest& request, int end);

}  // namespace flexspline::data
