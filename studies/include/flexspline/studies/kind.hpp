#pragma once

#include <span>
#include <string_view>

namespace flexspline::studies {

/// A row of the catalogue of study kinds: which cases a study consists of.
struct KindRow {
  std::string_view id;
  std::string_view summary;
  std::string_view cases;
};

/// Every kind, one file each in studies/kinds.
std::span<const KindRow> kinds();

}  // namespace flexspline::studies
