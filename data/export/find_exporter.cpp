#include <algorithm>

#include <fmt/format.h>

#include "flexspline/core/nearest_name.hpp"
#include "flexspline/data/exporter.hpp"

namespace flexspline::data {

Result<const ExporterRow*> find_exporter(std::string_view id) {
  std::vector<std::string_view> ids;
  for (const ExporterRow& row : exporters()) {
    if (row.id == id) return &row;
    ids.push_back(row.id);
  }
  return failure(ErrorCode::usage, fmt::format("there is no exporter '{}'", id),
                 suggestion(id, ids));
}

}  // namespace flexspline::data
