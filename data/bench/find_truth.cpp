#include <string>

#include "flexspline/data/bench.hpp"

namespace flexspline::data {

Result<const TruthRow*> find_truth(std::string_view id) {
  std::string known;
  for (const TruthRow& row : truths()) {
    if (row.id == id) return &row;
    known += (known.empty() ? "" : ", ") + std::string(row.id);
  }
  return failure(ErrorCode::usage, "truth \"" + std::string(id) + "\" does not exist",
                 "choose one of " + known);
}

}  // namespace flexspline::data
