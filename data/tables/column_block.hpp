#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "flexspline/data/table_reader.hpp"

namespace flexspline::data {

/// Rows at once where a reader holds whole columns.
inline constexpr std::size_t kBlockRows = 16384;

/// A table whose columns lie in memory, told to a sink by blocks.
inline void tell_table(const TableHead& head, const std::vector<std::vector<double>>& columns,
                       TableSink& sink) {
  const std::vector<std::size_t> wanted = sink.begin(head);
  if (wanted.empty()) return;
  const std::size_t rows = columns[wanted[0]].size();
  std::vector<std::vector<double>> block(wanted.size());
  for (std::size_t from = 0; from < rows; from += kBlockRows) {
    const std::size_t count = std::min(kBlockRows, rows - from);
    for (std::size_t w = 0; w < wanted.size(); ++w) {
      const auto begin = columns[wanted[w]].begin() + static_cast<std::ptrdiff_t>(from);
      block[w].assign(begin, begin + static_cast<std::ptrdiff_t>(count));
    }
    sink.rows(block);
  }
}

}  // namespace flexspline::data
