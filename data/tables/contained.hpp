#pragma once

#include "flexspline/data/table_reader.hpp"

namespace flexspline::data {

/// Runs a reader in a process of its own, with bounds on memory and on the time it says nothing.
/// Its crash, its hanging and what it says against the protocol are errors of this file: bad_data.
Result<void> read_contained(const TableReaderRow& reader, const std::filesystem::path& path,
                            const TableRequest& request, TableSink& sink);

}  // namespace flexspline::data
