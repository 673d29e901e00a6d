#pragma once

#include <string_view>
#include <vector>

#include "diagnosis/search/selection.hpp"

namespace flexspline::studies {

/// What the causes of a list are called.
inline std::vector<std::string_view> ids(const std::vector<Accepted>& causes) {
  std::vector<std::string_view> list;
  for (const Accepted& a : causes) list.push_back(a.trial.cause.row->id);
  return list;
}

}  // namespace flexspline::studies
